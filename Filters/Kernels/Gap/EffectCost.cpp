#include "Kernels/Gap/EffectCost.h"

#include "Kernels/Gap/TableDecisions.h"

#include <cmath>

namespace msi
{

namespace
{

double improbability(const EffectFitter& fitter, const EffectFit& fit)
{
  double sum = 0.0;
  for (const EffectChoice& choice : fit.set.choices)
  {
    sum +=
      TableDecision::UnlikelyForm * static_cast<double>(choice.form - choice.effect->forms.data());
    const bool onlyMedium = !choice.medium.empty() && fitter.data().scene.media().size() == 1;
    sum += onlyMedium || choice.whiteAfter ? TableDecision::UnlikelyForm : 0.0;
  }
  return sum;
}
}

double parameterPrice(const EffectFitter& fitter, double gapEnergy, double dispersion)
{
  const double chance = 0.5 * std::log(std::fmax(fitter.trainingElements(), 2.0)) * dispersion;
  return std::fmax(chance, TableDecision::FormPart * gapEnergy);
}

double costOf(const EffectFitter& fitter, const EffectFit& fit, double gapEnergy, double dispersion)
{
  return fit.energy +
    static_cast<double>(fit.parameters()) * parameterPrice(fitter, gapEnergy, dispersion) +
    improbability(fitter, fit) * dispersion;
}

} // namespace msi

#include "Kernels/Gap/EffectCost.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double UnlikelyForm =
  2.0; // dispersions: a form is e times less likely than the one before it

double improbability(const EffectFitter& fitter, const EffectFit& fit)
{
  double sum = 0.0;
  for (const EffectChoice& choice : fit.set.choices)
  {
    sum += UnlikelyForm * static_cast<double>(choice.form - choice.effect->forms.data());
    const bool onlyMedium = !choice.medium.empty() && fitter.data().scene.media().size() == 1;
    sum += onlyMedium || choice.whiteAfter ? UnlikelyForm : 0.0;
  }
  return sum;
}
}

double parameterPrice(const EffectFitter& fitter, double gapEnergy, double dispersion)
{
  const double chance = 0.5 * std::log(std::fmax(fitter.trainingElements(), 2.0)) * dispersion;
  return std::fmax(chance, FormPart * gapEnergy);
}

double costOf(const EffectFitter& fitter, const EffectFit& fit, double gapEnergy, double dispersion)
{
  return fit.energy +
    static_cast<double>(fit.parameters()) * parameterPrice(fitter, gapEnergy, dispersion) +
    improbability(fitter, fit) * dispersion;
}

} // namespace msi

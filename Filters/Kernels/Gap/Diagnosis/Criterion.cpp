#include "Kernels/Gap/Diagnosis/Criterion.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msi
{

namespace
{
double improbabilityOf(const GapOption& option)
{
  return option.improbability + Decision::StandIn * option.standIns;
}
}

Criterion::Criterion(const Observation& data, const ObservedFit& nominal, double numbers)
  : Data(data)
  , Gap(std::fmax(nominal.energy - data.noiseEnergy(), 0.0))
  , Noise(std::fmin(data.noiseEnergy(), nominal.energy))
  , Floor(std::fmax(Decision::FormPart * Gap, std::numeric_limits<double>::min()))
  , Discrepancy(std::clamp(static_cast<double>(data.energies(nominal).before.size()), 1.0, numbers))
  , Reference(std::numeric_limits<double>::infinity())
{
  refer(nominal.energy, nominal.coherence);
}

void Criterion::refer(double energy, double coherence)
{
  if (!(energy < Reference))
  {
    return;
  }
  Reference = energy;
  const double noise = std::fmin(Noise, Reference) / std::fmax(Data.elements(), 1.0);
  const double left = std::fmax(Reference - Noise, 0.0) + Floor;
  Dispersion = coherence * noise + left / Discrepancy;
  Numbers = (Reference + Floor) / Dispersion;
}

double Criterion::fitOf(double energy) const
{
  return -0.5 * Numbers * std::log((energy + Floor) / (Reference + Floor));
}

double Criterion::operator()(const ObservedFit& fit) const
{
  return std::isfinite(fit.energy) ? fitOf(fit.energy) - occam(fit) - improbability(fit)
                                   : -std::numeric_limits<double>::infinity();
}

double Criterion::preview(const ObservedFit& from, const GapPreview& with) const
{
  const double energy = std::fmax(from.energy - with.gain, std::fmin(Noise, from.energy)) +
    with.parameters * Dispersion;
  const GapOption& option = Data.options()[with.option];
  // Numbers of single channels have a variance that suits them.
  const double known = option.perChannel ? with.gain / (with.parameters * Dispersion) : Numbers;
  return fitOf(energy) - 0.5 * with.parameters * std::log(1.0 + std::fmax(known, 0.0)) -
    (option.perChannel ? 0.5 * with.parameters : 0.0) - improbabilityOf(option);
}

double Criterion::occam(const ObservedFit& fit) const
{
  return 0.5 * (1.0 + fit.information.array() / Dispersion).log().sum() + fit.surprise;
}

double Criterion::improbability(const ObservedFit& fit) const
{
  double sum = fit.atBound ? Decision::StandIn : 0.0;
  for (const std::size_t number : fit.set)
  {
    sum += improbabilityOf(Data.options()[number]);
  }
  return sum;
}

} // namespace msi

#include "Kernels/Gap/Field/FieldAcceptance.h"

#include "Kernels/Gap/Field/FieldDecisions.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
bool clears(double gain, double excess, double chance)
{
  return gain > ImageDecision::Cleared * excess && excess >= ImageDecision::OverNoise * chance;
}

double leastDeviations(double gain, double excess, double chance)
{
  if (excess < chance)
  {
    return ImageDecision::Significant;
  }
  const double part = (gain / excess - ImageDecision::RelevantOfRest) /
    (ImageDecision::Cleared - ImageDecision::RelevantOfRest);
  return ImageDecision::Significant -
    (ImageDecision::Significant - ImageDecision::SignificantWhereCleared) *
    std::clamp(part, 0.0, 1.0);
}
}

double FieldAcceptance::cost(const FieldFit& fit) const
{
  return fit.energy + price * static_cast<double>(parameterCount(fit.set, data.channels()));
}

bool FieldAcceptance::mayReplace(const FieldFit& current, const FieldFit& fit) const
{
  const double gain = cost(current) - cost(fit);
  return gain > price ||
    (gain > 0.0 &&
      parameterCount(fit.set, data.channels()) <= parameterCount(current.set, data.channels()) &&
      deviationsOf(data, current.blockEnergy - fit.blockEnergy) >=
        ImageDecision::SignificantWhereCleared);
}

bool FieldAcceptance::mayExchange(const FieldFit& current, const FieldFit& fit) const
{
  return cost(current) - cost(fit) > price &&
    deviationsOf(data, current.blockEnergy - fit.blockEnergy) >= ImageDecision::Significant;
}

bool FieldAcceptance::mayJoin(const FieldFit& current, const FieldFit& fit, double chance) const
{
  const double gain = current.energy - fit.energy;
  const double excess = std::fmax(current.energy - chance, 0.0);
  const auto parameters = static_cast<double>(
    parameterCount(fit.set, data.channels()) - parameterCount(current.set, data.channels()));
  if (gain < ImageDecision::PriceOfEffect * price * parameters ||
    deviationsOf(data, current.blockEnergy - fit.blockEnergy) <
      leastDeviations(gain, excess, chance))
  {
    return false;
  }
  // What is left of one effect of the edges looks like another.
  const bool besides = fit.set.back()->has(EffectTrait::ActsOnEdges) &&
    std::any_of(current.set.begin(), current.set.end(),
      [](const FieldChoice* other) { return other->has(EffectTrait::ActsOnEdges); });
  // A profile fits much that goes along the axes: it must be most of what is left.
  if (isProfile(*fit.set.back()) && gain < ImageDecision::MostOfRest * excess)
  {
    return false;
  }
  const double part = besides ? ImageDecision::RelevantBesides : ImageDecision::RelevantPart;
  return (gain >= part * gapEnergy && gain >= ImageDecision::RelevantOfRest * excess) ||
    (!besides && clears(gain, excess, chance)) ||
    (!besides && excess >= ImageDecision::BesideNoise * chance &&
      gain >= ImageDecision::MostOfRest * excess);
}

bool FieldAcceptance::mayStay(const FieldFit& current, const FieldFit& without, double chance) const
{
  const double gain = without.energy - current.energy;
  const double excess = std::fmax(without.energy - chance, 0.0);
  return (gain >= ImageDecision::RelevantPart * gapEnergy || clears(gain, excess, chance)) &&
    cost(without) >= cost(current) &&
    deviationsOf(data, without.blockEnergy - current.blockEnergy) >=
    ImageDecision::StaysIn * leastDeviations(gain, excess, chance);
}

} // namespace msi

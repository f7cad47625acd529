#include "Kernels/Gap/Field/FieldAcceptance.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
// Deviations over groups of blocks. An effect that clears what is left may concern few of them, as saturation does:
// from a tenth of what is left to all of it less and less is asked for.
constexpr double Significant = 3.0;
constexpr double SignificantWhereCleared = 2.0; // or where one takes another's place
constexpr double Cleared = 0.8;                 // of the energy beyond noise
constexpr double StaysIn = 0.85;
// What an effect must be worth.
constexpr double PriceOfEffect = 3.0;  // prices
constexpr double RelevantPart = 0.01;  // of the gap's energy
constexpr double RelevantOfRest = 0.1; // and of what is left of it
constexpr double MostOfRest =
  0.5; // this alone will do where what is left is not much less than noise
constexpr double BesideNoise = 0.5; // of what noise allows
constexpr double OverNoise = 0.1;   // of it, where an effect clears what is left
constexpr double RelevantBesides =
  0.03; // of the gap's energy, where an effect of the edges is there

bool clears(double gain, double excess, double chance)
{
  return gain > Cleared * excess && excess >= OverNoise * chance;
}

double leastDeviations(double gain, double excess, double chance)
{
  if (excess < chance)
  {
    return Significant;
  }
  const double part = (gain / excess - RelevantOfRest) / (Cleared - RelevantOfRest);
  return Significant - (Significant - SignificantWhereCleared) * std::clamp(part, 0.0, 1.0);
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
      deviationsOf(data, current.blockEnergy - fit.blockEnergy) >= SignificantWhereCleared);
}

bool FieldAcceptance::mayExchange(const FieldFit& current, const FieldFit& fit) const
{
  return cost(current) - cost(fit) > price &&
    deviationsOf(data, current.blockEnergy - fit.blockEnergy) >= Significant;
}

bool FieldAcceptance::mayJoin(const FieldFit& current, const FieldFit& fit, double chance) const
{
  const double gain = current.energy - fit.energy;
  const double excess = std::fmax(current.energy - chance, 0.0);
  const auto parameters = static_cast<double>(
    parameterCount(fit.set, data.channels()) - parameterCount(current.set, data.channels()));
  if (gain < PriceOfEffect * price * parameters ||
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
  if (isProfile(*fit.set.back()) && gain < MostOfRest * excess)
  {
    return false;
  }
  const double part = besides ? RelevantBesides : RelevantPart;
  return (gain >= part * gapEnergy && gain >= RelevantOfRest * excess) ||
    (!besides && clears(gain, excess, chance)) ||
    (!besides && excess >= BesideNoise * chance && gain >= MostOfRest * excess);
}

bool FieldAcceptance::mayStay(const FieldFit& current, const FieldFit& without, double chance) const
{
  const double gain = without.energy - current.energy;
  const double excess = std::fmax(without.energy - chance, 0.0);
  return (gain >= RelevantPart * gapEnergy || clears(gain, excess, chance)) &&
    cost(without) >= cost(current) &&
    deviationsOf(data, without.blockEnergy - current.blockEnergy) >=
    StaysIn * leastDeviations(gain, excess, chance);
}

} // namespace msi

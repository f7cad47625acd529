#include "Kernels/Gap/SmallErrors.h"

#include "Kernels/Gap/ChannelStructure.h"
#include "Kernels/Gap/EffectCost.h"
#include "Kernels/Gap/TableDecisions.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace msi
{

EffectFit addSmallErrors(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  std::vector<EffectChoice> errors;
  std::copy_if(choices.begin(), choices.end(), std::back_inserter(errors),
    [](const EffectChoice& choice) { return choice.smallError(); });
  // Gains first: they are the most frequent.
  std::stable_partition(errors.begin(), errors.end(),
    [](const EffectChoice& choice) { return choice.effect->has(EffectTrait::ChannelGain); });
  for (const EffectChoice& small : errors)
  {
    if (fit.set.has(small))
    {
      continue;
    }
    EffectSet set = fit.set;
    set.add(small, fitter.data().camera);
    EffectFit other = fitter.fit(std::move(set), SearchFit);
    const double gain = fit.energy - other.energy;
    if (gain > TableDecision::ChanceOfMany * other.dispersion &&
      gain > TableDecision::RelevantPart * gapEnergy)
    {
      fit = std::move(other);
    }
  }
  return fit;
}

EffectFit splitGains(
  const EffectFitter& fitter, EffectFit fit, const std::vector<EffectChoice>& choices)
{
  const auto gains = std::find_if(fit.set.choices.begin(), fit.set.choices.end(),
    [](const EffectChoice& c)
    { return c.effect->has(EffectTrait::ChannelGain) && c.smallError(); });
  if (gains == fit.set.choices.end())
  {
    return fit;
  }
  const EffectChoice gain = *gains;
  EffectSet rest = fit.set;
  rest.remove(static_cast<std::size_t>(gains - fit.set.choices.begin()));
  const EffectFit without = fitter.fit(rest, SearchFit);
  std::vector<EffectChoice> common;
  std::copy_if(choices.begin(), choices.end(), std::back_inserter(common),
    [&rest](const EffectChoice& choice)
    {
      return !choice.whiteAfter && !rest.has(choice) &&
        (choice.effect->has(EffectTrait::CommonGain) ||
          choice.effect->has(EffectTrait::SpectralGain));
    });
  // The best of many is as good as a single one by chance more often.
  double least =
    TableDecision::StructuredChance / std::fmax(static_cast<double>(common.size()), 1.0);
  EffectSet best;
  for (const EffectChoice& choice : common)
  {
    EffectSet set = rest;
    set.add(choice, fitter.data().camera);
    const EffectFit special = fitter.fit(set, SearchFit);
    const double fraction = (without.energy - special.energy) / (without.energy - fit.energy);
    const double chance =
      chanceOfFraction(fraction, static_cast<int>(special.parameters() - without.parameters()),
        static_cast<int>(fitter.data().channels()));
    if (chance < least)
    {
      least = chance;
      best = special.set;
    }
  }
  if (best.size() == 0)
  {
    return fit;
  }
  best.add(gain, fitter.data().camera);
  return fitter.fit(std::move(best), FinalFit);
}

} // namespace msi

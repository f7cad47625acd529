#include "Kernels/Gap/EffectRevision.h"

#include "Kernels/Gap/EffectCost.h"
#include "Kernels/Gap/EffectExtension.h"
#include "Kernels/Gap/EffectForms.h"
#include "Kernels/Gap/TableDecisions.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace msi
{

namespace
{

// All but one effect of the set; of three or more also all but two where `pairs`.
std::vector<EffectSet> partsToKeep(const EffectSet& set, bool pairs)
{
  std::vector<EffectSet> parts;
  for (std::size_t first = 0; first < set.size(); ++first)
  {
    EffectSet part = set;
    part.remove(first);
    for (std::size_t second = first; pairs && second < part.size() && set.size() > 2; ++second)
    {
      EffectSet smaller = part;
      smaller.remove(second);
      parts.push_back(std::move(smaller));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

// Fits of a part of the set and one fresh effect, where the screen holds out that they can compete.
std::vector<EffectFit> exchangesOf(const EffectFitter& fitter, const EffectSet& part,
  const std::vector<EffectChoice>& fresh, double gapEnergy, double present)
{
  const EffectFit kept = fitter.fit(part, SearchFit);
  const std::vector<ScreenedEffect> screened =
    screenEffects(fitter, kept, fresh, TableDecision::FormPart * gapEnergy);
  const auto promises = [&](const ScreenedEffect& effect)
  { return kept.energy - effect.gain < TableDecision::HopefulScreen * present; };
  if (part.size() > 1 && std::none_of(screened.begin(), screened.end(), promises))
  {
    return {};
  }
  return extendFit(fitter, kept, screened, TableDecision::ExchangesFitted);
}
}

EffectFit withoutMenders(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  for (std::size_t position = fit.set.size(); fit.set.size() > 1 && position-- > 0;)
  {
    EffectSet rest = fit.set;
    rest.remove(position);
    EffectFit other =
      chooseForms(fitter, fitter.fit(std::move(rest), SearchFit), choices, gapEnergy);
    if (costOf(fitter, other, gapEnergy, fit.dispersion) <
      costOf(fitter, fit, gapEnergy, fit.dispersion))
    {
      fit = std::move(other);
      position = fit.set.size();
    }
  }
  return fit;
}

EffectFit withoutSurplus(const EffectFitter& fitter, EffectFit fit, double gapEnergy)
{
  for (std::size_t position = 0; position < fit.set.size() && fit.set.size() > 1;)
  {
    EffectSet rest = fit.set;
    rest.remove(position);
    EffectFit other = fitter.fit(std::move(rest), SearchFit);
    const double loss = other.energy - fit.energy;
    if (costOf(fitter, other, gapEnergy, fit.dispersion) <=
        costOf(fitter, fit, gapEnergy, fit.dispersion) ||
      loss < std::fmax(TableDecision::ChanceOfMany * fit.dispersion,
               TableDecision::RelevantPart * gapEnergy))
    {
      fit = std::move(other);
      position = 0;
    }
    else
    {
      ++position;
    }
  }
  return fit;
}

EffectFit withExchanges(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy, bool pairs,
  const std::function<bool()>& stop)
{
  for (int round = 0; round < TableDecision::MostExchanges && fit.set.size() > 1 &&
       fit.energy > TableDecision::NoiseLeft * fitter.noiseEnergy();
       ++round)
  {
    const double dispersion = fit.dispersion;
    const auto cost = [&](const EffectFit& one)
    { return costOf(fitter, one, gapEnergy, dispersion); };
    const auto cheaper = [&](const EffectFit& a, const EffectFit& b) { return cost(a) < cost(b); };
    const EffectFit before = fit;
    const double present = cost(before);
    std::vector<EffectChoice> fresh;
    std::copy_if(choices.begin(), choices.end(), std::back_inserter(fresh),
      [&before](const EffectChoice& choice) { return !before.set.has(choice); });
    std::vector<EffectFit> hopeful;
    for (const EffectSet& part : partsToKeep(before.set, pairs))
    {
      if (stop())
      {
        return fit;
      }
      std::vector<EffectFit> others = exchangesOf(fitter, part, fresh, gapEnergy, present);
      std::stable_sort(others.begin(), others.end(), cheaper);
      // What is kept may be in a form that suits only what went; the fewer are kept, the more that says.
      const bool alone = part.size() == 1;
      others.resize(
        std::min<std::size_t>(others.size(), alone ? TableDecision::ExchangesFitted : 1));
      std::copy_if(std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()),
        std::back_inserter(hopeful),
        [&](const EffectFit& other)
        { return alone || cost(other) < TableDecision::HopefulFit * present; });
    }
    std::stable_sort(hopeful.begin(), hopeful.end(), cheaper);
    hopeful.resize(std::min<std::size_t>(hopeful.size(), TableDecision::ExchangesFormed));
    for (EffectFit& other : hopeful)
    {
      EffectFit formed = chooseForms(fitter, std::move(other), choices, gapEnergy);
      if (cost(formed) + dispersion < cost(fit))
      {
        fit = std::move(formed);
      }
    }
    if (fit.set.sameCauses(before.set))
    {
      break;
    }
    const bool much = cost(fit) < TableDecision::WorthAnotherRound * present;
    fit = withoutSurplus(fitter, std::move(fit), gapEnergy);
    if (!much)
    {
      break;
    }
  }
  return fit;
}

} // namespace msi

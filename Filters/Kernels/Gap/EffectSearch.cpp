#include "Kernels/Gap/EffectSearch.h"

#include "Kernels/Gap/EffectCost.h"
#include "Kernels/Gap/EffectForms.h"
#include "Kernels/Gap/SmallErrors.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int Iterations = 6;
constexpr int FormsFitted = 2; // of one effect
constexpr int FinalIterations = 20;
constexpr double IdlePart = 0.001; // of the gap's energy
constexpr int MostExchanges = 3;
constexpr int ExchangesFitted = 3; // for each effect that may go
constexpr double NoiseLeft = 1.1;  // times the noise: nothing is left to do better

bool sameCauses(const EffectSet& a, const EffectSet& b)
{
  return a.size() == b.size() &&
    std::all_of(
      a.choices.begin(), a.choices.end(), [&b](const EffectChoice& c) { return b.has(c); });
}

// One fit for each set of causes, the cheapest.
void keepBestForms(
  std::vector<EffectFit>& fits, const std::function<double(const EffectFit&)>& price)
{
  std::stable_sort(fits.begin(), fits.end(),
    [&price](const EffectFit& a, const EffectFit& b) { return price(a) < price(b); });
  std::vector<EffectFit> kept;
  for (EffectFit& fit : fits)
  {
    const bool known = std::any_of(kept.begin(), kept.end(),
      [&fit](const EffectFit& other) { return sameCauses(fit.set, other.set); });
    if (!known)
    {
      kept.push_back(std::move(fit));
    }
  }
  fits = std::move(kept);
}

// An effect in a form that is not quite right leaves a rest that others mend, numbers of single channels above all, and
// they then hide the form that is right. Where the rest of the causes in their best forms do as well for the price, an
// effect goes.
EffectFit withoutMenders(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  for (std::size_t position = fit.set.size(); fit.set.size() > 1 && position-- > 0;)
  {
    EffectSet rest = fit.set;
    rest.remove(position);
    EffectFit other =
      chooseForms(fitter, fitter.fit(std::move(rest), Iterations), choices, gapEnergy);
    if (costOf(fitter, other, gapEnergy, fit.dispersion) <
      costOf(fitter, fit, gapEnergy, fit.dispersion))
    {
      fit = std::move(other);
      position = fit.set.size();
    }
  }
  return fit;
}

// Drops effects again that are not worth their price.
EffectFit withoutSurplus(const EffectFitter& fitter, EffectFit fit, double gapEnergy)
{
  for (std::size_t position = 0; position < fit.set.size() && fit.set.size() > 1;)
  {
    EffectSet rest = fit.set;
    rest.remove(position);
    EffectFit other = fitter.fit(std::move(rest), Iterations);
    const double loss = other.energy - fit.energy;
    if (costOf(fitter, other, gapEnergy, fit.dispersion) <=
        costOf(fitter, fit, gapEnergy, fit.dispersion) ||
      loss < std::fmax(ChanceOfMany * fit.dispersion, RelevantPart * gapEnergy))
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

// Beside effects that came later some do nothing any more.
void dropIdle(const EffectFitter& fitter, SearchResult& result)
{
  for (std::size_t position = result.best.set.size(); position-- > 0;)
  {
    if (fitter.contribution(result.best, position).squaredNorm() < IdlePart * result.gapEnergy)
    {
      EffectSet rest = result.best.set;
      rest.remove(position);
      result.best = fitter.fit(std::move(rest), FinalIterations);
      result.causes -= position < result.causes ? 1 : 0;
    }
  }
}

// All but one effect of the set; of three or more also all but two.
std::vector<EffectSet> partsToKeep(const EffectSet& set)
{
  std::vector<EffectSet> parts;
  for (std::size_t first = 0; first < set.size(); ++first)
  {
    EffectSet part = set;
    part.remove(first);
    for (std::size_t second = first; second < part.size() && set.size() > 2; ++second)
    {
      EffectSet smaller = part;
      smaller.remove(second);
      parts.push_back(std::move(smaller));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

// A set that grew effect by effect holds some that only suited the forms of those before them. Where another effect, the
// others in the forms that it asks for, costs less in the place of one, or of two, it takes it.
EffectFit withExchanges(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy, const std::function<bool()>& stop)
{
  for (int round = 0;
       round < MostExchanges && fit.set.size() > 1 && fit.energy > NoiseLeft * fitter.noiseEnergy();
       ++round)
  {
    const double dispersion = fit.dispersion;
    const auto cost = [&](const EffectFit& one)
    { return costOf(fitter, one, gapEnergy, dispersion); };
    const EffectFit before = fit;
    for (const EffectSet& part : partsToKeep(before.set))
    {
      if (stop())
      {
        return fit;
      }
      std::vector<EffectChoice> fresh;
      std::copy_if(choices.begin(), choices.end(), std::back_inserter(fresh),
        [&before](const EffectChoice& choice) { return !before.set.has(choice); });
      std::vector<EffectFit> others =
        extendFit(fitter, fitter.fit(part, Iterations), fresh, gapEnergy, ExchangesFitted);
      std::stable_sort(others.begin(), others.end(),
        [&](const EffectFit& a, const EffectFit& b) { return cost(a) < cost(b); });
      // What is kept may be in a form that suits only what went; the fewer are kept, the more that says.
      others.resize(std::min<std::size_t>(others.size(), part.size() == 1 ? ExchangesFitted : 1));
      for (EffectFit& other : others)
      {
        EffectFit formed = chooseForms(fitter, std::move(other), choices, gapEnergy);
        if (cost(formed) + dispersion < cost(fit))
        {
          fit = std::move(formed);
        }
      }
    }
    if (sameCauses(fit.set, before.set))
    {
      break;
    }
    fit = withoutSurplus(fitter, std::move(fit), gapEnergy);
  }
  return fit;
}
}

std::vector<EffectFit> extendFit(const EffectFitter& fitter, const EffectFit& current,
  const std::vector<EffectChoice>& choices, double gapEnergy, int fullFits)
{
  const double price = FormPart * gapEnergy;
  std::vector<EffectFit> fits;
  std::vector<EffectChoice> forms;
  for (const ScreenedEffect& screened : screenEffects(fitter, current, choices, price))
  {
    if (static_cast<int>(fits.size()) >= fullFits || screened.gain <= ChanceOfMany)
    {
      break;
    }
    const auto alike = std::count_if(forms.begin(), forms.end(),
      [&screened](const EffectChoice& form) { return form.sameCause(screened.choice); });
    if (alike >= FormsFitted + (hasSecondary(screened.choice) ? 1 : 0))
    {
      continue;
    }
    forms.push_back(screened.choice);
    EffectSet set = current.set;
    set.add(screened.choice, fitter.data().camera, screened.start);
    EffectFit fit = fitter.fit(std::move(set), Iterations);
    if (std::isfinite(fit.energy))
    {
      fits.push_back(withSecondary(fitter, std::move(fit), current.set.size(), Iterations));
    }
  }
  return fits;
}

SearchResult searchEffects(const EffectFitter& fitter, const std::vector<EffectChoice>& choices,
  const SearchLimits& limits, const std::function<bool()>& stop)
{
  SearchResult result;
  result.best = fitter.nominal();
  result.gapEnergy = std::fmax(result.best.energy - fitter.noiseEnergy(), 0.0);
  const double gapEnergy = result.gapEnergy;
  std::vector<EffectFit> beam{ result.best };
  for (int size = 1; size <= limits.maximumEffects && !stop(); ++size)
  {
    std::vector<EffectFit> grown;
    for (const EffectFit& from : beam)
    {
      if (stop())
      {
        return result;
      }
      std::vector<EffectFit> more = extendFit(fitter, from, choices, gapEnergy, limits.fullFits);
      std::move(more.begin(), more.end(), std::back_inserter(grown));
    }
    if (grown.empty())
    {
      break;
    }
    const auto least = std::min_element(grown.begin(), grown.end(),
      [](const EffectFit& a, const EffectFit& b) { return a.energy < b.energy; });
    const double dispersion = least->dispersion;
    const auto price = [&](const EffectFit& fit)
    { return costOf(fitter, fit, gapEnergy, dispersion); };
    keepBestForms(grown, price);
    if (size == 1)
    {
      result.singles = grown;
    }
    const double improvement = result.best.energy - grown.front().energy;
    if (price(grown.front()) < price(result.best) && improvement > ChanceOfMany * dispersion &&
      improvement > RelevantPart * gapEnergy)
    {
      result.best = grown.front();
    }
    else if (size > 1)
    {
      break;
    }
    grown.resize(std::min(grown.size(), static_cast<std::size_t>(limits.width)));
    beam = std::move(grown);
  }
  if (result.best.set.size() == 0 || stop())
  {
    return result;
  }
  result.best = withoutMenders(fitter, std::move(result.best), choices, gapEnergy);
  result.best = withoutSurplus(fitter, std::move(result.best), gapEnergy);
  result.best = chooseForms(fitter, std::move(result.best), choices, gapEnergy);
  result.best = withExchanges(fitter, std::move(result.best), choices, gapEnergy, stop);
  result.best = preferExposure(fitter, std::move(result.best), choices, gapEnergy);
  if (static_cast<int>(result.best.set.size()) < limits.maximumEffects)
  {
    result.best = splitGains(fitter, std::move(result.best), choices);
  }
  result.causes = result.best.set.size();
  if (static_cast<int>(result.causes) < limits.maximumEffects)
  {
    result.best = addSmallErrors(fitter, std::move(result.best), choices, gapEnergy);
  }
  result.best = leadingForms(fitter, std::move(result.best), choices, gapEnergy);
  dropIdle(fitter, result);
  return result;
}

} // namespace msi

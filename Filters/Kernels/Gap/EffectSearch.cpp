#include "Kernels/Gap/EffectSearch.h"

#include "Kernels/Gap/EffectCost.h"
#include "Kernels/Gap/EffectExtension.h"
#include "Kernels/Gap/EffectForms.h"
#include "Kernels/Gap/EffectRevision.h"
#include "Kernels/Gap/SmallErrors.h"
#include "Kernels/Gap/TableDecisions.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{

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
      [&fit](const EffectFit& other) { return fit.set.sameCauses(other.set); });
    if (!known)
    {
      kept.push_back(std::move(fit));
    }
  }
  fits = std::move(kept);
}

// The first ones that do not do the same, filled up with others: many effects darken a picture, and in a row of them what
// only darkens a part of it would have no place.
std::vector<EffectFit> differentOnes(
  const EffectFitter& fitter, std::vector<EffectFit> fits, std::size_t count)
{
  std::vector<EffectFit> kept;
  std::vector<EffectFit> others;
  std::vector<Eigen::VectorXd> changes;
  for (EffectFit& fit : fits)
  {
    const Eigen::VectorXd change = fitter.weighted(fit.predicted - fitter.data().simulated);
    const bool known = std::any_of(changes.begin(), changes.end(),
      [&change](const Eigen::VectorXd& other)
      {
        return (change - other).squaredNorm() <
          TableDecision::AlikePart * std::fmin(change.squaredNorm(), other.squaredNorm());
      });
    if (!known && kept.size() < count)
    {
      changes.push_back(change);
      kept.push_back(std::move(fit));
    }
    else
    {
      others.push_back(std::move(fit));
    }
  }
  std::move(others.begin(),
    others.begin() + static_cast<std::ptrdiff_t>(std::min(others.size(), count - kept.size())),
    std::back_inserter(kept));
  return kept;
}

// Beside effects that came later some do nothing any more.
void dropIdle(const EffectFitter& fitter, SearchResult& result)
{
  for (std::size_t position = result.best.set.size(); position-- > 0;)
  {
    if (fitter.contribution(result.best, position).squaredNorm() <
      TableDecision::IdlePart * result.gapEnergy)
    {
      EffectSet rest = result.best.set;
      rest.remove(position);
      result.best = fitter.fit(std::move(rest), FinalFit);
      result.causes -= position < result.causes ? 1 : 0;
    }
  }
}
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
      std::vector<EffectFit> more = extendFit(fitter, from,
        screenEffects(fitter, from, choices, TableDecision::FormPart * gapEnergy), limits.fullFits);
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
    if (price(grown.front()) < price(result.best) &&
      improvement > TableDecision::ChanceOfMany * dispersion &&
      improvement > TableDecision::RelevantPart * gapEnergy)
    {
      result.best = grown.front();
    }
    else if (size > 1)
    {
      break;
    }
    beam = differentOnes(fitter, std::move(grown), static_cast<std::size_t>(limits.width));
  }
  if (result.best.set.size() == 0 || stop())
  {
    return result;
  }
  result.best = withoutMenders(fitter, std::move(result.best), choices, gapEnergy);
  result.best = withoutSurplus(fitter, std::move(result.best), gapEnergy);
  result.best = chooseForms(fitter, std::move(result.best), choices, gapEnergy);
  result.best =
    withExchanges(fitter, std::move(result.best), choices, gapEnergy, limits.exchangePairs, stop);
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

#include "Kernels/Gap/GapCauses.h"

#include "Kernels/Gap/CauseShares.h"
#include "Kernels/Gap/EffectCost.h"
#include "Kernels/Gap/EffectExtension.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Shrink.h"
#include "Kernels/Gap/TableDecisions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

namespace msi
{

namespace
{

// The place of a step lies between two samples; the error is that of a uniform distribution there.
void addPlace(GapCause& cause, const EffectSet& set, std::size_t position, double samples)
{
  if (const auto place = set.placeOf(position))
  {
    cause.parameters.push_back(
      { place->parameter->name, set.effects[position].parameters[place->index],
        place->parameter->unit, 1.0 / (samples * std::sqrt(12.0)) });
  }
}

// Effects that do as well in the place of one of the causes.
std::vector<std::string> equivalentsOf(const EffectFitter& fitter, const SearchResult& found,
  const std::vector<EffectChoice>& choices, std::size_t position)
{
  const EffectFit& best = found.best;
  EffectSet rest = best.set;
  rest.remove(position);
  std::vector<EffectChoice> others;
  std::copy_if(choices.begin(), choices.end(), std::back_inserter(others),
    [&](const EffectChoice& choice) {
      return choice.effect->name != best.set.choices[position].effect->name && !rest.has(choice);
    });
  const EffectFit without = fitter.fit(rest, SearchFit);
  const std::vector<EffectFit> alternatives = extendFit(fitter, without,
    screenEffects(fitter, without, others, TableDecision::FormPart * found.gapEnergy),
    TableDecision::AlternativesFitted);
  std::vector<Rival> rivals;
  const double price = parameterPrice(fitter, found.gapEnergy, best.dispersion);
  const auto cost = [price](const EffectFit& fit)
  { return fit.energy + price * static_cast<double>(fit.parameters()); };
  const double tolerance = std::fmax(TableDecision::EquivalentPart * found.gapEnergy,
    TableDecision::EquivalentDeviations * best.dispersion);
  for (const EffectFit& alternative : alternatives)
  {
    if (cost(alternative) <= cost(best) + tolerance)
    {
      rivals.push_back({ alternative.set.choices.back().effect->name, cost(alternative) });
    }
  }
  return cheapestOf(std::move(rivals));
}
}

std::vector<GapCause> describeCauses(const EffectFitter& fitter, const SearchResult& found,
  const std::vector<EffectChoice>& choices, double total, double doubt)
{
  const EffectFit& best = found.best;
  const std::size_t count = best.set.size();
  const std::vector<CauseShare> shares = causeShares(fitter, best, total, doubt);
  const Eigen::VectorXd errors = count > 0
    ? Eigen::VectorXd(fitter.covariance(best).diagonal().cwiseMax(0.0).cwiseSqrt())
    : Eigen::VectorXd();
  std::vector<GapCause> causes;
  for (std::size_t e = 0; e < count; ++e)
  {
    GapCause cause;
    cause.effect = best.set.choices[e].effect->name;
    cause.form = best.set.choices[e].form->name;
    cause.medium = best.set.choices[e].medium;
    cause.share = shares[e].share;
    cause.shrink = shares[e].alone;
    cause.undone = shares[e].undone;
    if (e < found.causes)
    {
      cause.equivalent = equivalentsOf(fitter, found, choices, e);
    }
    for (std::size_t p = 0; p < best.free.size(); ++p)
    {
      const FreeParameter& parameter = best.free[p];
      const bool level = parameter.effect == count && best.set.choices[e].leveled;
      if (parameter.effect == e || level)
      {
        cause.parameters.push_back({ parameter.name, valueOf(best.set, parameter), parameter.unit,
          errors[static_cast<Eigen::Index>(p)] });
      }
    }
    addPlace(cause, best.set, e, fitter.trainingSamples());
    causes.push_back(std::move(cause));
  }
  std::stable_sort(causes.begin(), causes.end(),
    [](const GapCause& a, const GapCause& b) { return a.share > b.share; });
  return causes;
}

std::vector<GapCandidate> describeCandidates(
  const EffectFitter& fitter, const SearchResult& found, std::uint64_t seed)
{
  std::vector<GapCandidate> candidates;
  for (const EffectFit& single : found.singles)
  {
    const EffectChoice& choice = single.set.choices.front();
    const double shrink = shrinkOf(fitter, single);
    std::array<double, 2> interval = shrinkInterval(energiesOf(fitter, single), seed);
    interval = { std::fmin(interval[0], shrink), std::fmax(interval[1], shrink) };
    candidates.push_back(
      { choice.effect->name, choice.form->name, choice.medium, shrink, interval });
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const GapCandidate& a, const GapCandidate& b) { return a.shrink > b.shrink; });
  return candidates;
}

} // namespace msi

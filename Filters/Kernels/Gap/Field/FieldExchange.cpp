#include "Kernels/Gap/Field/FieldExchange.h"

#include "Kernels/Gap/Field/FieldDecisions.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace msi
{

namespace
{
constexpr std::size_t LargestSet = 4;
constexpr std::size_t Leading = 8; // effects that are tried beside every other
constexpr std::size_t Refitted = 2;

// The effects of `part`, in whatever form.
bool hasAll(const FieldSet& set, const FieldSet& part)
{
  return std::all_of(part.begin(), part.end(),
    [&set](const FieldChoice* choice) { return contains(set, *choice->effect); });
}

bool sameEffects(const FieldSet& a, const FieldSet& b)
{
  return a.size() == b.size() && hasAll(a, b);
}

// All but one of the set, and all but two.
std::vector<FieldSet> partsToKeep(const FieldSet& set)
{
  std::vector<FieldSet> parts;
  for (std::size_t first = 0; first < set.size(); ++first)
  {
    const FieldSet part = withoutOne(set, first);
    for (std::size_t second = first; second < part.size(); ++second)
    {
      parts.push_back(withoutOne(part, second));
    }
    parts.push_back(part);
  }
  return parts;
}
}

void FieldExchange::extend(
  const FieldFitter& fitter, const FieldSet& rest, std::vector<FieldFit>& found) const
{
  const auto cheaper = [this](const FieldFit& a, const FieldFit& b) { return cost(a) < cost(b); };
  std::vector<FieldFit> singles;
  for (const FieldChoice& choice : Choices)
  {
    if (available(rest, choice))
    {
      singles.push_back(linearFit(fitter, joined(rest, choice), FieldDetail::Sum));
    }
  }
  std::stable_sort(singles.begin(), singles.end(), cheaper);
  for (std::size_t i = 0; i < std::min(Leading, singles.size()); ++i)
  {
    for (const FieldChoice& choice : Choices)
    {
      if (available(singles[i].set, choice))
      {
        found.push_back(linearFit(fitter, joined(singles[i].set, choice), FieldDetail::Sum));
      }
    }
  }
  std::move(singles.begin(), singles.end(), std::back_inserter(found));
}

std::vector<FieldFit> FieldExchange::promising(
  const FieldFitter& fitter, double most, std::size_t largest) const
{
  std::vector<FieldFit> found;
  for (const FieldSet& rest : partsToKeep(Current.set))
  {
    extend(fitter, rest, found);
  }
  std::stable_sort(found.begin(), found.end(),
    [this](const FieldFit& a, const FieldFit& b) { return cost(a) < cost(b); });
  std::vector<FieldFit> best;
  for (FieldFit& fit : found)
  {
    // What only adds to the set is for growing to find.
    const bool known = hasAll(fit.set, Current.set) ||
      std::any_of(best.begin(), best.end(),
        [&fit](const FieldFit& other) { return sameEffects(fit.set, other.set); });
    if (best.size() < Refitted && !known && fit.set.size() <= largest && cost(fit) < most)
    {
      best.push_back(std::move(fit));
    }
  }
  return best;
}

bool FieldExchange::newOnesCount(const FieldHypothesis& hypothesis) const
{
  const FieldFitter fitter(Data, *hypothesis.statistics);
  for (std::size_t e = 0; e < hypothesis.set.size(); ++e)
  {
    const FieldChoice* choice = hypothesis.set[e];
    const FieldSet rest = withoutOne(hypothesis.set, e);
    FieldFit fit = hypothesis.fit;
    fit.set = joined(rest, *choice);
    if (!contains(Current.set, *choice->effect) &&
      !acceptance().mayJoin(fitter.fit(rest), fit, fitter.chance()))
    {
      return false;
    }
  }
  return true;
}

bool FieldExchange::exchangePairs(int maximumEffects)
{
  if (Current.set.empty() || Current.set.size() > LargestSet)
  {
    return false;
  }
  const FieldFitter here(Data, *Current.statistics);
  if (Current.set.size() == 1 &&
    Current.fit.energy < (1.0 + ImageDecision::NothingLeft) * here.chance())
  {
    return false;
  }
  const auto largest = static_cast<std::size_t>(maximumEffects);
  std::vector<FieldFit> others = promising(here, cost(Current.fit) - Result.price, largest);
  const FieldStatistics nominal = nominalStatistics();
  const FieldFitter start(Data, nominal);
  std::vector<FieldFit> fromStart =
    promising(start, cost(linearFit(start, Current.set, FieldDetail::Sum)) - Result.price, largest);
  std::move(fromStart.begin(), fromStart.end(), std::back_inserter(others));
  const FieldHypothesis* best = nullptr;
  std::vector<FieldHypothesis> fitted;
  fitted.reserve(others.size());
  for (const FieldFit& other : others)
  {
    fitted.push_back(refit(other.set, other.next));
    if (clips(fitted.back()) && acceptance().mayExchange(Current.fit, fitted.back().fit) &&
      (best == nullptr || cost(fitted.back().fit) < cost(best->fit)) && newOnesCount(fitted.back()))
    {
      best = &fitted.back();
    }
  }
  if (best == nullptr)
  {
    return false;
  }
  accept(*best);
  return true;
}

} // namespace msi

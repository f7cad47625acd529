#include "Kernels/Gap/Field/FieldRevision.h"

#include "Kernels/Gap/Field/FieldDecisions.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace msi
{

void FieldRevision::consider(FieldFit fit, std::optional<FieldFit>& best) const
{
  if (acceptance().mayReplace(Current.fit, fit) && (!best || cost(fit) < cost(*best)))
  {
    best = std::move(fit);
  }
}

bool FieldRevision::takeOver(const std::optional<FieldFit>& best)
{
  if (!best)
  {
    return false;
  }
  const FieldHypothesis other = refit(best->set, best->next);
  if (!acceptance().mayReplace(Current.fit, other.fit))
  {
    return false;
  }
  accept(other);
  return true;
}

void FieldRevision::chooseForm()
{
  const FieldFitter fitter(Data, *Current.statistics);
  const FieldSet rest = withoutOne(Current.set, Current.set.size() - 1);
  const FieldChoice* last = Current.set.back();
  std::optional<FieldFit> best;
  for (const FieldChoice& choice : Choices)
  {
    if (&choice != last && choice.effect == last->effect && available(rest, choice))
    {
      consider(linearFit(fitter, joined(rest, choice)), best);
    }
  }
  takeOver(best);
}

void FieldRevision::tryTrend()
{
  FieldSet set;
  std::copy_if(Current.set.begin(), Current.set.end(), std::back_inserter(set),
    [](const FieldChoice* choice) { return !choice->has(EffectTrait::SmoothInField); });
  if (std::none_of(set.begin(), set.end(), [](const FieldChoice* c) { return isProfile(*c); }))
  {
    return;
  }
  const FieldHypothesis before = Current;
  const FieldWeights weights = Result.weights;
  const double price = Result.price;
  KeepTrend = true;
  accept(refit(set, FieldFitter(Data, *Current.statistics).fit(set).next));
  const FieldHypothesis with = refitted(Data, weights, set, Current.fit.next, Loop);
  if (with.fit.energy > before.fit.energy - price)
  {
    KeepTrend = false;
    Current = before;
    Result.weights = weights;
    Result.price = price;
  }
}

bool FieldRevision::exchange()
{
  const FieldFitter fitter(Data, *Current.statistics);
  std::optional<FieldFit> best;
  for (std::size_t e = 0; e < Current.set.size(); ++e)
  {
    const FieldSet rest = withoutOne(Current.set, e);
    for (const FieldChoice& choice : Choices)
    {
      if (&choice == Current.set[e] || !available(rest, choice))
      {
        continue;
      }
      const FieldSet other = joined(rest, choice);
      FieldFit fit = linearFit(fitter, other);
      if (fit.energy < Current.fit.energy + ImageDecision::Tolerated * Result.gapEnergy)
      {
        for (const FieldSet& simple : simpler(other))
        {
          consider(linearFit(fitter, simple), best);
        }
      }
      consider(std::move(fit), best);
    }
  }
  for (const FieldSet& other : otherLight())
  {
    consider(linearFit(fitter, other), best);
  }
  return takeOver(best);
}

std::vector<FieldSet> FieldRevision::otherLight() const
{
  std::vector<FieldSet> sets;
  for (std::size_t e = 0; e < Current.set.size(); ++e)
  {
    const FieldChoice* mine = Current.set[e];
    if (!mine->has(ImageParameter::Falloff))
    {
      continue;
    }
    FieldSet rest = withoutOne(Current.set, e);
    const bool off = hasTerm({ mine }, ImageParameter::CenterX);
    const FieldChoice* gradient = nullptr;
    for (const FieldChoice& choice : Choices)
    {
      const bool plane =
        choice.has(ImageParameter::GradientRight) && !choice.has(ImageParameter::GradientBend);
      gradient = plane ? &choice : gradient;
    }
    if (gradient == nullptr || hasTerm(rest, ImageParameter::GradientRight) == off)
    {
      continue;
    }
    rest.erase(
      std::remove_if(rest.begin(), rest.end(),
        [](const FieldChoice* choice) { return choice->has(ImageParameter::GradientRight); }),
      rest.end());
    for (const FieldChoice& choice : Choices)
    {
      if (choice.effect == mine->effect && choice.form == mine->form &&
        hasTerm({ &choice }, ImageParameter::CenterX) != off)
      {
        sets.push_back(joined(off ? joined(rest, *gradient) : rest, choice));
      }
    }
  }
  return sets;
}

std::vector<FieldSet> FieldRevision::simpler(const FieldSet& set) const
{
  std::vector<FieldSet> sets;
  for (std::size_t e = 0; e < set.size(); ++e)
  {
    for (const FieldChoice& choice : Choices)
    {
      if (choice.effect == set[e]->effect &&
        parameterCount({ &choice }, Data.channels()) <
          parameterCount({ set[e] }, Data.channels()) &&
        available(withoutOne(set, e), choice))
      {
        sets.push_back(joined(withoutOne(set, e), choice));
      }
    }
  }
  return sets;
}

bool FieldRevision::drop()
{
  const FieldFitter fitter(Data, *Current.statistics);
  for (std::size_t e = Current.set.size(); e-- > 0;)
  {
    const FieldFit fit = fitter.fit(withoutOne(Current.set, e));
    if (!acceptance().mayStay(Current.fit, fit, fitter.chance()))
    {
      accept(refit(fit.set, fit.next));
      return true;
    }
  }
  return false;
}

} // namespace msi

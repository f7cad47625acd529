#include "Kernels/Gap/Field/FieldSearch.h"

#include "Kernels/Gap/Field/FieldExchange.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace msi
{

namespace
{
constexpr int BackwardRounds = 4;
constexpr int PairRounds = 2;
constexpr std::size_t FullFits = 2;

class Search : public FieldExchange
{
public:
  using FieldExchange::FieldExchange;

  FieldSearchResult run(int maximumEffects, const std::function<bool()>& stop)
  {
    const auto growAll = [&]
    {
      while (
        static_cast<int>(Current.set.size()) < maximumEffects && !stop() && grow(maximumEffects))
      {
        chooseForm();
      }
    };
    const auto revise = [&]
    {
      for (int round = 0; round < BackwardRounds && !stop() && (exchange() || drop()); ++round)
      {
      }
    };
    growAll();
    revise();
    for (int round = 0; round < PairRounds && !stop() && exchangePairs(maximumEffects); ++round)
    {
      growAll();
      revise();
    }
    tryTrend();
    return result();
  }

private:
  // Forms ranked by cost; of each effect the best.
  std::vector<FieldFit> rank(const FieldFitter& fitter, const FieldSet& set)
  {
    std::vector<FieldFit> fits;
    for (const FieldChoice& choice : Choices)
    {
      if (available(set, choice))
      {
        fits.push_back(linearFit(fitter, joined(set, choice)));
      }
    }
    std::stable_sort(fits.begin(), fits.end(),
      [this](const FieldFit& a, const FieldFit& b) { return cost(a) < cost(b); });
    std::vector<FieldFit> best;
    for (FieldFit& fit : fits)
    {
      const EffectDefinition* effect = fit.set.back()->effect;
      if (std::none_of(best.begin(), best.end(),
            [effect](const FieldFit& other) { return other.set.back()->effect == effect; }))
      {
        best.push_back(std::move(fit));
      }
    }
    return best;
  }

  bool grow(int maximumEffects)
  {
    findStarts();
    const FieldFitter fitter(Data, *Current.statistics);
    std::vector<FieldFit> ranked = rank(fitter, Current.set);
    if (Current.set.empty())
    {
      Result.indistinct = indistinctEffects(Data, fitter, Choices);
      for (const FieldFit& fit : ranked)
      {
        Result.singles.push_back({ fit.set.back(), fit.energy, fit.blockEnergy });
      }
    }
    std::vector<FieldHypothesis> fitted;
    const auto tryOut = [&](const FieldSet& set, const FieldModel& start)
    {
      FieldHypothesis hypothesis = refit(set, start);
      if (clips(hypothesis))
      {
        fitted.push_back(std::move(hypothesis));
      }
    };
    if (static_cast<int>(Current.set.size()) + 2 <= maximumEffects)
    {
      rankWithGain(fitter, ranked);
    }
    // The cheapest; and the cheapest of those that count as they stand.
    std::size_t counted = 0;
    for (std::size_t i = 0; i < ranked.size(); ++i)
    {
      const bool counts =
        counted < FullFits && acceptance().mayJoin(Current.fit, ranked[i], fitter.chance());
      counted += counts ? 1 : 0;
      if (i < FullFits || counts)
      {
        tryOut(ranked[i].set, ranked[i].next);
      }
    }
    for (const FieldChoice& choice : Choices)
    {
      if (choice.has(ImageParameter::Right) && compatible(Current.set, choice))
      {
        const FieldSet set = joined(Current.set, choice);
        const bool similar = hasTerm(set, ImageParameter::Rotation);
        const Eigen::MatrixXd& place = similar ? Start.similarity : Start.shift;
        FieldModel start = Current.statistics->model;
        start[ImageParameter::Right] = place.col(0);
        start[ImageParameter::Down] = place.col(1);
        start[ImageParameter::Magnification] = place.col(2);
        start[ImageParameter::Rotation] = place.col(3);
        if (!place.isZero() && (!similar || place.rightCols(2).any()))
        {
          tryOut(set, start);
        }
      }
    }
    const FieldHypothesis* best = nullptr;
    for (const FieldHypothesis& hypothesis : fitted)
    {
      keepSingle(hypothesis);
      if ((best == nullptr || cost(hypothesis.fit) < cost(best->fit)) &&
        acceptance().mayJoin(Current.fit, hypothesis.fit, fitter.chance()))
      {
        best = &hypothesis;
      }
    }
    if (best == nullptr)
    {
      return false;
    }
    accept(*best);
    return true;
  }

  // Where no effect counts alone: each with a gain or an offset beside it. Light that falls off, seen against a white in the
  // same light, is too bright in the middle and too dark at the border: no single effect.
  void rankWithGain(const FieldFitter& fitter, std::vector<FieldFit>& ranked)
  {
    const double chance = fitter.chance();
    const auto counts = [&](const FieldFit& fit)
    { return acceptance().mayJoin(Current.fit, fit, chance); };
    if (Current.fit.energy < 2.0 * chance || std::any_of(ranked.begin(), ranked.end(), counts))
    {
      return;
    }
    for (const FieldChoice& choice : Choices)
    {
      if (choice.has(EffectTrait::Exact) && available(Current.set, choice))
      {
        for (FieldFit& fit : rank(fitter, joined(Current.set, choice)))
        {
          if (counts(fit))
          {
            ranked.push_back(std::move(fit));
          }
        }
      }
    }
    std::stable_sort(ranked.begin(), ranked.end(),
      [this](const FieldFit& a, const FieldFit& b) { return cost(a) < cost(b); });
  }

  // What the first effect does alone, where it was fitted in full.
  void keepSingle(const FieldHypothesis& hypothesis)
  {
    for (FieldSingle& single : Result.singles)
    {
      if (Current.set.empty() && hypothesis.set.size() == 1 &&
        single.choice->effect == hypothesis.set.back()->effect &&
        hypothesis.fit.energy < single.energy)
      {
        single = { hypothesis.set.back(), hypothesis.fit.energy, hypothesis.fit.blockEnergy };
      }
    }
  }
};
}

FieldSearchResult searchField(const FieldData& data, const std::vector<FieldChoice>& choices,
  int maximumEffects, const FieldLoop& loop, const std::function<bool()>& stop)
{
  return Search(data, choices, loop).run(maximumEffects, stop);
}

} // namespace msi

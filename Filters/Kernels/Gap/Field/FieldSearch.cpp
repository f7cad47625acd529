#include "Kernels/Gap/Field/FieldSearch.h"

#include "Kernels/Gap/Field/FieldAcceptance.h"
#include "Kernels/Gap/Field/FieldClip.h"
#include "Kernels/Gap/Field/FieldHypothesis.h"
#include "Kernels/Gap/Field/FieldShift.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace msi
{

namespace
{
constexpr double Tolerated = 0.01; // of the gap's energy, on the way to a simpler form
constexpr double LeastClip = 0.7;
constexpr int BackwardRounds = 4;
constexpr double PricePart = 0.0005;  // for a parameter
constexpr double LargestPricePart = 0.001;
constexpr std::size_t FullFits = 2;

class Search
{
public:
  Search(const FieldData& data, const std::vector<FieldChoice>& choices, const FieldLoop& loop)
    : Data(data)
    , Choices(choices)
    , Loop(loop)
    , Nominal(data.channels())
  {
    Result.before = fieldStatistics(data, Nominal, nullptr, loop);
    Result.weights = fieldWeights(Result.before, nullptr);
    // Once more with noise known, and what the tolerance does with it.
    measureNominal();
    Shifts = wholePixelShifts(data, loop);
  }

  FieldSearchResult run(int maximumEffects, const std::function<bool()>& stop)
  {
    while (static_cast<int>(Current.set.size()) < maximumEffects && !stop() && grow())
    {
    }
    for (int round = 0; round < BackwardRounds && !stop() && (exchange() || drop()); ++round)
    {
    }
    Result.set = Current.set;
    Result.after = *Current.statistics;
    return Result;
  }

private:
  const FieldData& Data;
  const std::vector<FieldChoice>& Choices;
  const FieldLoop& Loop;
  FieldModel Nominal;
  Eigen::MatrixXd Shifts;
  FieldHypothesis Current;
  FieldSearchResult Result;

  FieldAcceptance acceptance() const { return { Data, Result.gapEnergy, Result.price }; }
  double cost(const FieldFit& fit) const { return acceptance().cost(fit); }

  void measureNominal()
  {
    const auto statistics =
      std::make_shared<FieldStatistics>(fieldStatistics(Data, Nominal, &Result.weights, Loop));
    Result.before = *statistics;
    const FieldFitter fitter(Data, *statistics);
    Result.gapEnergy = std::fmax(fitter.energy() - fitter.chance(), 0.0);
    Current = { {}, statistics, fitter.fit({}) };
    setPrice(fitter);
  }

  void setPrice(const FieldFitter& fitter)
  {
    double blocks = 0.0;
    for (const FieldBlock& block : Data.blocks)
    {
      blocks += block.fold >= 0 ? 1.0 : 0.0;
    }
    const double least = 0.5 * std::log(blocks);
    const double dispersion = fitter.energy() / std::fmax(fitter.chance(), 1e-9) *
      blockMeanExcess(Data, fitter.statistics(), true);
    Result.price = std::fmax(std::fmax(least, PricePart * Result.gapEnergy),
      std::fmin(least * dispersion, LargestPricePart * fitter.energy()));
  }

  FieldHypothesis refit(const FieldSet& set, const FieldModel& start) const
  {
    return refitted(Data, Result.weights, set, start, Loop);
  }

  // Looks for stripes and clipping in what is left.
  void findStarts()
  {
    FieldModel model = Current.statistics->model;
    bool found = false;
    if (!contains(Current.set, "banding", "rows"))
    {
      Result.rows = findPeriod(Data, model, true, Loop);
      found = found || Result.rows.period != model.rowPeriod;
      model.rowPeriod = Result.rows.period;
    }
    if (!contains(Current.set, "banding", "columns"))
    {
      Result.columns = findPeriod(Data, model, false, Loop);
      found = found || Result.columns.period != model.columnPeriod;
      model.columnPeriod = Result.columns.period;
    }
    if (!contains(Current.set, "saturation"))
    {
      const double level = findClipLevel(Data, model, Loop);
      found = found || level != model.at(FieldParameter::ClipLevel, 0);
      model[FieldParameter::ClipLevel].setConstant(level);
    }
    if (found)
    {
      Current.statistics =
        std::make_shared<FieldStatistics>(fieldStatistics(Data, model, &Result.weights, Loop));
      Current.fit = FieldFitter(Data, *Current.statistics).fit(Current.set);
    }
  }

  bool available(const FieldSet& set, const FieldChoice& choice) const
  {
    const FieldModel& model = Current.statistics->model;
    if (choice.effect == "banding" &&
      (choice.form == "rows" ? model.rowPeriod : model.columnPeriod) <= 0.0)
    {
      return false;
    }
    if (choice.effect == "saturation" && model.isNeutral(FieldParameter::ClipLevel))
    {
      return false;
    }
    return compatible(set, choice);
  }

  bool shifted() const { return Shifts.cwiseAbs().maxCoeff() >= 1.0; }

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
      const std::string& effect = fit.set.back()->effect;
      if (std::none_of(best.begin(), best.end(),
            [&effect](const FieldFit& other) { return other.set.back()->effect == effect; }))
      {
        best.push_back(std::move(fit));
      }
    }
    return best;
  }

  bool grow()
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
      // What bends the curve does not clip.
      if (!contains(set, "saturation") ||
        hypothesis.statistics->model.at(FieldParameter::Clip, 0) >= LeastClip)
      {
        fitted.push_back(std::move(hypothesis));
      }
    };
    // The cheapest; and the cheapest of those that count as they stand.
    std::size_t counted = 0;
    for (std::size_t i = 0; i < ranked.size(); ++i)
    {
      const bool counts = counted < FullFits &&
        acceptance().mayJoin(Current.fit, ranked[i], fitter.chance());
      counted += counts ? 1 : 0;
      if (i < FullFits || counts)
      {
        tryOut(ranked[i].set, ranked[i].next);
      }
    }
    for (const FieldChoice& choice : Choices)
    {
      if (shifted() && choice.effect == "misregistration" && compatible(Current.set, choice))
      {
        FieldModel start = Current.statistics->model;
        start[FieldParameter::Right] = Shifts.col(0);
        start[FieldParameter::Down] = Shifts.col(1);
        tryOut(joined(Current.set, choice), start);
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

  // What the first effect does alone, where it was fitted in full.
  void keepSingle(const FieldHypothesis& hypothesis)
  {
    for (FieldSingle& single : Result.singles)
    {
      if (Current.set.empty() && single.choice->effect == hypothesis.set.back()->effect &&
        hypothesis.fit.energy < single.energy)
      {
        single = { hypothesis.set.back(), hypothesis.fit.energy, hypothesis.fit.blockEnergy };
      }
    }
  }

  // Goes on from here, with weights for what is left.
  void accept(const FieldHypothesis& hypothesis)
  {
    const FieldModel model = hypothesis.fit.next;
    const Eigen::ArrayXd tolerance = Result.weights.tolerance;
    const FieldStatistics plain = fieldStatistics(Data, model, &Result.weights, Loop);
    Result.weights = fieldWeights(plain, &tolerance);
    Current = refit(hypothesis.set, model);
    setPrice(FieldFitter(Data, *Current.statistics));
  }

  // Puts another effect or form in the place of each, and a simpler form in the place of one more.
  bool exchange()
  {
    const FieldFitter fitter(Data, *Current.statistics);
    std::optional<FieldFit> best;
    const auto consider = [&](FieldFit fit)
    {
      if (cost(fit) < cost(Current.fit) - Result.price && (!best || cost(fit) < cost(*best)))
      {
        best = std::move(fit);
      }
    };
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
        if (fit.energy < Current.fit.energy + Tolerated * Result.gapEnergy)
        {
          for (const FieldSet& simple : simpler(other))
          {
            consider(linearFit(fitter, simple));
          }
        }
        consider(std::move(fit));
      }
    }
    if (!best)
    {
      return false;
    }
    const FieldHypothesis other = refit(best->set, best->next);
    if (cost(other.fit) >= cost(Current.fit) - Result.price)
    {
      return false;
    }
    accept(other);
    return true;
  }

  // The set with a form of fewer parameters in the place of one.
  std::vector<FieldSet> simpler(const FieldSet& set) const
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

  bool drop()
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
};
}

double blockMeanExcess(const FieldData& data, const FieldStatistics& statistics, bool training)
{
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    for (Eigen::Index k = 0; (data.blocks[b].fold >= 0) == training && k < data.channels(); ++k)
    {
      const BlockSums& sums = statistics.at(b, k);
      if (sums.pixels > 0.0)
      {
        sum += sums.mean * sums.mean * sums.pixels * sums.pixels / sums.noise;
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

FieldSearchResult searchField(const FieldData& data, const std::vector<FieldChoice>& choices,
  int maximumEffects, const FieldLoop& loop, const std::function<bool()>& stop)
{
  return Search(data, choices, loop).run(maximumEffects, stop);
}

} // namespace msi

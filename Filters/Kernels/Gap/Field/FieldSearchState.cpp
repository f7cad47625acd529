#include "Kernels/Gap/Field/FieldSearchState.h"

#include "Kernels/Gap/Field/FieldClip.h"
#include "Kernels/Gap/Field/FieldDecisions.h"
#include "Kernels/Gap/Field/FieldProfile.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace msi
{

namespace
{
bool hasProfile(const FieldSet& set, bool rows)
{
  return std::any_of(set.begin(), set.end(),
    [rows](const FieldChoice* choice) { return isProfile(*choice) && isOfRows(*choice) == rows; });
}

FieldSet withoutChoice(FieldSet set, const FieldChoice* choice)
{
  set.erase(std::remove(set.begin(), set.end(), choice), set.end());
  return set;
}
}

FieldSearchState::FieldSearchState(
  const FieldData& data, const std::vector<FieldChoice>& choices, const FieldLoop& loop)
  : Data(data)
  , Choices(choices)
  , Loop(loop)
{
  Result.before = fieldStatistics(data, FieldModel(data.channels()), nullptr, loop);
  Result.weights = fieldWeights(Result.before, nullptr);
  // Once more with noise known, and what the tolerance does with it.
  measureNominal();
  Limit = Result.weights.limit;
  Start = registrationStart(data, loop);
}

FieldSearchResult FieldSearchState::result() const
{
  FieldSearchResult result = Result;
  result.set = Current.set;
  result.after = *Current.statistics;
  return result;
}

void FieldSearchState::measureNominal()
{
  const auto statistics = std::make_shared<FieldStatistics>(
    fieldStatistics(Data, FieldModel(Data.channels()), &Result.weights, Loop));
  Result.before = *statistics;
  const FieldFitter fitter(Data, *statistics);
  Result.gapEnergy = std::fmax(fitter.energy() - fitter.chance(), 0.0);
  Current = { {}, statistics, fitter.fit({}) };
  setPrice(fitter);
}

void FieldSearchState::setPrice(const FieldFitter& fitter)
{
  double blocks = 0.0;
  for (const FieldBlock& block : Data.blocks)
  {
    blocks += block.fold >= 0 ? 1.0 : 0.0;
  }
  const double least = 0.5 * std::log(blocks);
  const double dispersion = fitter.energy() / std::fmax(fitter.chance(), 1e-9) *
    blockMeanExcess(Data, fitter.statistics(), true);
  Result.price = std::fmax(std::fmax(least, ImageDecision::PricePart * Result.gapEnergy),
    std::fmin(least * dispersion, ImageDecision::LargestPricePart * fitter.energy()));
}

bool FieldSearchState::available(const FieldSet& set, const FieldChoice& choice) const
{
  const FieldModel& model = Current.statistics->model;
  if (isBanding(choice))
  {
    const bool rows = isOfRows(choice);
    const bool known = isProfile(choice) ? (rows ? model.rows : model.columns) != nullptr
                                         : (rows ? model.rowPeriod : model.columnPeriod) > 0.0;
    if (!known)
    {
      return false;
    }
  }
  if (choice.has(ImageParameter::Clip) && model.isNeutral(ImageParameter::ClipLevel))
  {
    return false;
  }
  return compatible(set, choice);
}

bool FieldSearchState::clips(const FieldHypothesis& hypothesis)
{
  return !hasTerm(hypothesis.set, ImageParameter::Clip) ||
    hypothesis.statistics->model.at(ImageParameter::Clip, 0) >= ImageDecision::LeastClip;
}

FieldStatistics FieldSearchState::nominalStatistics() const
{
  const FieldModel& current = Current.statistics->model;
  FieldModel model(Data.channels());
  model.rowPeriod = current.rowPeriod;
  model.columnPeriod = current.columnPeriod;
  model.rows = current.rows;
  model.columns = current.columns;
  model[ImageParameter::ClipLevel] = current[ImageParameter::ClipLevel];
  return fieldStatistics(Data, model, &Result.weights, Loop);
}

void FieldSearchState::findStarts()
{
  FieldModel model = Current.statistics->model;
  bool found = false;
  if (!hasTerm(Current.set, ImageParameter::RowSine))
  {
    Result.rows = findPeriod(Data, model, true, Loop);
    found = found || Result.rows.period != model.rowPeriod;
    model.rowPeriod = Result.rows.period;
  }
  if (!hasTerm(Current.set, ImageParameter::ColumnSine))
  {
    Result.columns = findPeriod(Data, model, false, Loop);
    found = found || Result.columns.period != model.columnPeriod;
    model.columnPeriod = Result.columns.period;
  }
  if (!hasProfile(Current.set, true) || !hasProfile(Current.set, false))
  {
    findProfiles(model, Current.set);
    found = true;
  }
  if (!hasTerm(Current.set, ImageParameter::Clip))
  {
    const double level = findClipLevel(Data, model, Loop);
    found = found || level != model.at(ImageParameter::ClipLevel, 0);
    model[ImageParameter::ClipLevel].setConstant(level);
  }
  if (found)
  {
    Current.statistics =
      std::make_shared<FieldStatistics>(fieldStatistics(Data, model, &Result.weights, Loop));
    Current.fit = FieldFitter(Data, *Current.statistics).fit(Current.set);
  }
}

// Of lines whose profile is not in the set; those of others stay as they are.
void FieldSearchState::findProfiles(FieldModel& model, const FieldSet& set) const
{
  const auto find = [&](bool rows)
  {
    return std::make_shared<const FieldProfile>(
      findProfile(Data, model, rows, KeepTrend, Limit, Loop));
  };
  if (!hasProfile(set, true))
  {
    model.rows = find(true);
  }
  if (!hasProfile(set, false))
  {
    model.columns = find(false);
  }
}

void FieldSearchState::accept(const FieldHypothesis& hypothesis)
{
  FieldModel model = hypothesis.fit.next;
  for (const FieldChoice* choice : hypothesis.set)
  {
    if (isProfile(*choice))
    {
      // Once more beside the other effects.
      const Eigen::ArrayXd strength = model[choice->terms.front().parameter];
      model[choice->terms.front().parameter].setZero();
      findProfiles(model, withoutChoice(hypothesis.set, choice));
      model[choice->terms.front().parameter] = strength;
    }
  }
  const Eigen::ArrayXd tolerance = Result.weights.tolerance;
  const FieldStatistics plain = fieldStatistics(Data, model, &Result.weights, Loop);
  Result.weights = fieldWeights(plain, &tolerance);
  Current = refit(hypothesis.set, model);
  setPrice(FieldFitter(Data, *Current.statistics));
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

} // namespace msi

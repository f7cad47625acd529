// A set of effects fitted in full, and what it costs.
#pragma once

#include "Kernels/Gap/Field/FieldFit.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

struct FieldHypothesis
{
  FieldSet set;
  std::shared_ptr<const FieldStatistics> statistics; // with the columns of the set, or all
  FieldFit fit;
};

FieldSet joined(FieldSet set, const FieldChoice& choice);

template <typename Condition>
bool hasChoice(const FieldSet& set, Condition condition)
{
  return std::any_of(
    set.begin(), set.end(), [&](const FieldChoice* choice) { return condition(*choice); });
}

// The model after Gauss-Newton from a start.
FieldHypothesis refitted(const FieldData& data, const FieldWeights& weights, const FieldSet& set,
  const FieldModel& start, const FieldLoop& loop);

// One step; effects that the model does not have yet start from the best of their starts (ImageTerm::starts).
FieldFit linearFit(
  const FieldFitter& fitter, const FieldSet& set, FieldDetail detail = FieldDetail::Blocks);

// Effects among `choices` whose parameters this scene does not show.
std::vector<std::string> indistinctEffects(
  const FieldData& data, const FieldFitter& fitter, const std::vector<FieldChoice>& choices);

} // namespace msi

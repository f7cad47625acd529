// A set of effects fitted in full, and what it costs.
#pragma once

#include "Kernels/Gap/Field/FieldFit.h"

#include <memory>
#include <string>
#include <vector>

namespace msi
{

struct FieldHypothesis
{
  FieldSet set;
  std::shared_ptr<const FieldStatistics> statistics;
  FieldFit fit;
};

FieldSet joined(FieldSet set, const FieldChoice& choice);

bool hasTerm(const FieldSet& set, ImageParameter parameter);

// The model after Gauss-Newton from a start.
FieldHypothesis refitted(const FieldData& data, const FieldWeights& weights, const FieldSet& set,
  const FieldModel& start, const FieldLoop& loop);

// One step; the radius of a tail and the center of vignetting that the model does not have yet are the best of several.
FieldFit linearFit(
  const FieldFitter& fitter, const FieldSet& set, FieldDetail detail = FieldDetail::Blocks);

// Effects among `choices` whose parameters this scene does not show.
std::vector<std::string> indistinctEffects(
  const FieldData& data, const FieldFitter& fitter, const std::vector<FieldChoice>& choices);

} // namespace msi

// Where in an image pair a gap lies.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldStatistics.h"
#include "Kernels/Gap/GapReport.h"

#include <vector>

namespace msi
{

// Axes and their bases on the pixels of a block:
//
//   channel        an offset and a gain of each channel
//   level          u and u^2, common to all channels
//   position       u times a quadratic in x and y, for each channel
//   edges          derivatives of the image by displacement and blur, the surround minus u, for each channel
//   rows, columns  stripes, where a period was found
//   sample         (with labels) a mean of its own for each label and channel: what the others leave of it
//   region         (without labels) means of blocks: what the others leave
// Fitted on the training blocks; the shares are Shapley values of the R^2 on the test blocks, of the energy beyond
// noise. A common gain is level's.
std::vector<GapAxis> fieldAxes(
  const FieldData& data, const FieldStatistics& statistics, const FieldLoop& loop);

} // namespace msi

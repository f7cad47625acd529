// Stripes: a period of rows or columns in a residual.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"

#include <Eigen/Core>

namespace msi
{

struct FieldPeriod
{
  double period = 0.0; // pixels; 0: nothing beyond chance
  double standardError = 0.0;
};

// The period of a gain that goes with the row (or column), the same in all channels, phases and sizes free.
//
// Method: least-squares periodogram (N. R. Lomb, 1976, doi:10.1007/BF00648343) of the relative gain of each row of the
//   training blocks, quadratic trend taken off; the channels' powers add. The largest power counts where noise
//   of the same median power would reach it anywhere in the spectrum with a probability below 1e-3.
// Range: 2 pixels to half the span.
FieldPeriod findPeriod(
  const FieldData& data, const FieldModel& model, bool alongRows, const FieldLoop& loop);

} // namespace msi

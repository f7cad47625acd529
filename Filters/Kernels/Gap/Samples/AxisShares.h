// Along which axes the gap of a table lies.
#pragma once

#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

struct AxisShares
{
  std::vector<GapAxis> axes;       // sorted; those with nothing at all are left out
  double predictable = 0.0;        // energy that all bases together predict on held-out samples
  Eigen::MatrixXd heldOutResidual; // what they do not, K x S
};

// Ridge regression of `gap` over the folds on the bases of the axes that this capture has:
//
//   channel         an offset of each channel, and a gain of each channel apart from the common one
//   level           u, u^2, u^3 and the part above the 90 % level, common to all channels, zero at u = 0
//   medium, scene   of each: an offset in each channel, a gain, a curve
//   position        u times a quadratic in x and y; the surround minus u
//   order           u times a quadratic and four steps in time; time; a slope of its own for each channel
//   spectral_shape  slope and curvature of the reflectance under each passband, its mean over wavelength,
//                   the neighbouring channels' difference
//
// A common gain is level's, a common offset channel's. gap: 0 where nothing was measured. Where channel and level alone predict
// nine tenths of what all axes predict, the other axes are asked only for contrasts: a gap that is the same in every medium is not
// the medium's. Else they keep their common part: a gap in one of two media is the medium's, not half of it the level's.
// The axes' shares are Shapley values of the held-out R^2, in parts of the energy beyond noise. `sample` is the rest that goes with single samples: what the
// mean over one half of the channels tells about the other half.
AxisShares shareOverAxes(const GapData& data, const Eigen::MatrixXd& gap);

} // namespace msi

// Whether a table shows a gap, along which axes it lies, and whether causes account for it.
#pragma once

#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

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

// K x S throughout; `gap`, `before`, `after`: real minus simulated, 0 where nothing was measured.

// The error of the sums over wavelength is estimated from their steps and may be too large: where less is left than
// it allows, only as much of it stays in data.variance as what is left shows. Returns the mean variance taken away.
double limitIntegration(GapData& data, const Eigen::MatrixXd& integration, double unpredicted);

// Whether the bases predict held-out samples: their gain in energy, sample by sample, against its own error.
bool predictable(const GapData& data, const Eigen::MatrixXd& gap, const AxisShares& shares);

// Energy that errors of sums over wavelength, or a small part of what is left, may be.
double negligibleEnergy(
  const GapData& data, const Eigen::MatrixXd& after, const Eigen::MatrixXd& integration);

// What the causes take away over what errors of sums over wavelength and of reflectance could be: on average, or in single
// samples that make up most of it. Noticeable beyond 1; 0 where they take nothing away.
double noticed(const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
  const Eigen::MatrixXd& integration);

// oddElements() by what is left of them with and without the causes found, channels of samples.
IndexList oddElements(
  const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after);

// Whether a change of the response stands in so few samples that none of them can be left out to check it.
bool inFewSamples(const GapData& data, const Eigen::MatrixXd& change);

} // namespace msi

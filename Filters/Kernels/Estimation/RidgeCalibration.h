// Reflectance transform from few samples: ridge regression with the penalty chosen by leave-one-out.
#pragma once

#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Estimation/SampleSet.h"

namespace msi
{

struct RidgeFit
{
  CalibrationFit fit;
  double penalty;        // lambda that was chosen; 0 where least squares is best
  double leaveOneOutRms; // rms over bands and left-out samples at that penalty
  Eigen::MatrixXd
    leftOut; // N x L, what the fit to all others leaves of each sample at that penalty
  Eigen::VectorXd leverage; // L, of each sample on its own estimate: 0 .. 1
};

// W with the least ||R - W U~||^2 + lambda L ||W_s scale||^2: the channels are centered and divided by
// their standard deviation, so that a camera whose channels differ in gain is treated alike; the
// constant is not penalized. lambda is the one of 0 and 10^-8, 10^-7.75, .., 10^2 with the least
// leave-one-out error, which has a closed form. A channel that never varies gets coefficient 0.
//
// Source:  ridge regression: Hoerl and Kennard, 1970, doi 10.1080/00401706.1970.10488634; closed-form
//          leave-one-out (PRESS): Allen, 1974, doi 10.1080/00401706.1974.10489157.
// Shapes:  samples N x L and K x L; W is N x (K+1).
// Errors:  std::invalid_argument from requireValid(samples, "calibration"), and for fewer than 3 samples.
// Summary: residualRms of the fitted samples; rank and condition of the centered, scaled responses.
// Cost:    O(L K min(L, K) + steps (L K + N L)).
RidgeFit fitRidge(const SampleSet& samples);

} // namespace msi

// How well a set of effects accounts for a capture, its parameters integrated out: the logarithm of its marginal likelihood.
#pragma once

#include "Kernels/Gap/EffectFit.h"

#include <Eigen/Core>

namespace withheld
{

// Per sample i, with whitened elements (times the root of the fit's weights),
//
//   residual_i = J_i (theta - theta^) + Z_i b + e_i,   e_i ~ N(0, Sigma),   Sigma ~ inverse Wishart about 1
//
// J: derivatives by the effects' parameters at the fit. Z: gain, dark and center of each channel, which no camera has
// exactly. Samples are the groups; Sigma is what their channels have in common beyond all effects, and is
// integrated out. Numbers of single channels have a normal prior whose variance is learned from the capture, about the size that is
// usual: of an effect, its parameter's typical size; of every camera's small errors, a fraction of it. Other parameters have the
// fit's prior. Laplace's method at the most probable values.
class SetEvidence
{
public:
  explicit SetEvidence(const msi::EffectFitter& fitter);

  // Without the prior of the set.
  double logOf(const msi::EffectFit& fit) const;

private:
  struct Group
  {
    Eigen::Index first = 0, count = 0;
    double usual = 0.0; // standard deviation; 0: fixed
  };
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns) const;

  const msi::EffectFitter& Fitter;
  Eigen::ArrayXd Root;           // of the weights, elements
  Eigen::MatrixXd CenterColumns; // KS x K
};

} // namespace withheld

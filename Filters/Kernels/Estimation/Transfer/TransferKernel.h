// The covariance of the method "transfer" between two samples, each of the chart or of the target.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace msi
{

// Variances and length of
//   k(x, x') = c + c_t d d' + (l + l_t d d') x.x'/K + (g + g_t d d') exp(-|x - x'|^2 / (2 K s^2)),
// with d = 1 for a target sample and 0 for a chart sample; plus the noise of the sample's own set.
// What the media share stands without index, what only the target has with index t. Held as natural
// logarithms in one vector, the form in which they are fitted.
struct TransferKernel
{
  enum Parameter : Eigen::Index
  {
    Constant,
    Linear,
    Smooth,
    Length,
    TargetConstant,
    TargetLinear,
    TargetSmooth,
    ChartNoise,
    TargetNoise,
    Count
  };

  Eigen::VectorXd logarithms;

  double operator[](Parameter parameter) const { return std::exp(logarithms[parameter]); }
};

// Where the fit starts, and the center of its prior: for features and outputs of unit variance.
TransferKernel startingKernel();

// x . x' / K and |x - x'|^2 / K of the columns of two feature matrices.
Eigen::MatrixXd scaledProducts(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd scaledDistances(
  const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& products);

// Without noise; the first columns of a and of b are chart samples, the others target samples.
Eigen::MatrixXd covariance(const TransferKernel& kernel, const Eigen::MatrixXd& a,
  Eigen::Index chartOfA, const Eigen::MatrixXd& b, Eigen::Index chartOfB);

} // namespace msi

// Regression on the samples nearest to a pixel's response, run on blocks of pixels.
#pragma once

#include "Kernels/Estimation/ReflectanceEstimator.h"

#include <vector>

namespace msi
{

// The samples that a local regression chooses from.
struct LocalSamples
{
  Eigen::VectorXd scale;       // K: responses times this are compared with the points
  Eigen::MatrixXd points;      // K x n
  Eigen::MatrixXd regressors;  // K x n: what the response is regressed on, in units of the response
  Eigen::VectorXd weights;     // n, positive
  Eigen::MatrixXd reflectance; // N x n
  Eigen::VectorXd noise; // K, variance of the response that is added to that of the regressors
  double ridge = 0.0;    // added variance as a share of the regressors' mean variance
  Eigen::Index neighbours = 0; // samples that take part, at most n
};

// With the neighbours j nearest to the scaled response x, weighted by w_j (1 - (d_j / d)^3)^3 where d is
// the distance of the first sample that takes no part, or 1.001 times the largest:
//   mean = r + C_rx (C_xx + diag(noise) + ridge tr(C_xx) / K I)^-1 (u - x_mean),
// C the weighted covariances, r the weighted mean reflectance.
//
// Source: local regression: Cleveland, 1979, doi 10.1080/01621459.1979.10481038.
// Names:  local.scale (K x 1), local.points (K x n), local.regressors (K x n), local.weights (n x 1),
//         local.reflectance (N x n), local.noise (K x 1), local.scalars (2 x 1: ridge, neighbours).
// Errors: the constructor throws std::invalid_argument naming a matrix that is missing, of the wrong
//         shape or not finite, and where the number of neighbours is not within 1..n.
// Cost:   about n K + L K^2 + K^3 / 3 + L N multiplications for L neighbours and one selection per
//         pixel, in double: the slowest kind of estimator.
class LocalEstimator final : public ReflectanceEstimator
{
public:
  explicit LocalEstimator(LocalSamples samples);
  explicit LocalEstimator(const NamedMatrices& parameters);

  NamedMatrices parameters() const override;
  Eigen::Index bands() const noexcept override { return Samples.reflectance.rows(); }
  Eigen::Index channels() const noexcept override { return Samples.points.rows(); }
  using ReflectanceEstimator::apply;
  void apply(const double* response, double* mean, double* standardDeviation,
    Eigen::Index pixels) const noexcept override;

private:
  LocalSamples Samples;
};

// One estimate without one of the samples (none: -1), for the choice of hyperparameters.
Eigen::VectorXd localEstimate(
  const LocalSamples& samples, const Eigen::VectorXd& response, Eigen::Index withoutSample = -1);

} // namespace msi

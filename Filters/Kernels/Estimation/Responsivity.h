// The camera as the samples show it, for the Wiener estimators.
#pragma once

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/AffineTransform.h"

#include <Eigen/Core>

namespace msi
{

struct ResponsivityFit
{
  AffineTransform camera; // u = M r + b, K x (N+1)
  Eigen::VectorXd
    noise; // K, weighted mean squared residual, at least 1e-12 of the mean square response
};

// The least sum_i w_i |u_i - M r_i - b|^2 + ridge sum_i w_i s^2 |M|^2 with s^2 the mean variance of the
// weighted reflectances. weights are positive, one per sample; ridge > 0.
ResponsivityFit fitResponsivity(
  const SampleSet& samples, const Eigen::VectorXd& weights, double ridge);

// Weighted mean of columns.
Eigen::VectorXd weightedMean(const Eigen::MatrixXd& values, const Eigen::VectorXd& weights);

} // namespace msi

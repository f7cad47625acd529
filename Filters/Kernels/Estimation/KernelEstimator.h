// Kernel regression run on blocks of pixels.
#pragma once

#include "Kernels/Estimation/ReflectanceEstimator.h"

namespace msi
{

enum class RegressionKernel
{
  Gaussian,   // exp(-d^2 / 2)
  Logarithmic // -log(1 + d^2), conditionally positive definite
};

// Kernel values between the columns of a and b. The logarithmic kernel is completed by
// log(1 + |x|^2) + log(1 + |x'|^2), which makes it positive semidefinite.
Eigen::MatrixXd kernelMatrix(
  RegressionKernel kernel, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// mean = constant + coefficients' k(x), x = scale u - offset, k_j(x) = k(x, p_j).
//
// Names:  kernel.kind (1 x 1: 0 Gaussian, 1 logarithmic), kernel.channels (K x 2: scale, offset),
//         kernel.points (K x m), kernel.coefficients (m x N), kernel.constant (N x 1).
// Errors: the constructor throws std::invalid_argument naming a matrix that is missing, of the wrong
//         shape or not finite.
// Cost:   m (2 K + 2 N) flop and m exponentials or logarithms per pixel, in double.
class KernelEstimator final : public ReflectanceEstimator
{
public:
  explicit KernelEstimator(const NamedMatrices& parameters);

  NamedMatrices parameters() const override { return Parameters; }
  Eigen::Index bands() const noexcept override { return Constant.size(); }
  Eigen::Index channels() const noexcept override { return Points.rows(); }
  using ReflectanceEstimator::apply;
  void apply(const double* response, double* mean, double* standardDeviation,
    Eigen::Index pixels) const noexcept override;

private:
  NamedMatrices Parameters;
  RegressionKernel Kernel;
  Eigen::VectorXd Scale;
  Eigen::VectorXd Offset;
  Eigen::MatrixXd Points;
  Eigen::MatrixXd Transposed; // coefficients, N x m
  Eigen::VectorXd Constant;
};

} // namespace msi

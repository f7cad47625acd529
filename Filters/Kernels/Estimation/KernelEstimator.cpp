#include "Kernels/Estimation/KernelEstimator.h"

#include <cmath>
#include <stdexcept>

namespace msi
{

namespace
{
double kernelValue(RegressionKernel kernel, double squaredDistance) noexcept
{
  return kernel == RegressionKernel::Gaussian ? std::exp(-0.5 * squaredDistance)
                                              : -std::log1p(squaredDistance);
}

const std::string KernelOwner = "the kernel estimator";
}

Eigen::MatrixXd kernelMatrix(
  RegressionKernel kernel, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  Eigen::MatrixXd values(a.cols(), b.cols());
  for (Eigen::Index j = 0; j < b.cols(); ++j)
  {
    for (Eigen::Index i = 0; i < a.cols(); ++i)
    {
      values(i, j) = kernelValue(kernel, (a.col(i) - b.col(j)).squaredNorm());
    }
  }
  if (kernel == RegressionKernel::Logarithmic)
  {
    const auto fromOrigin = [](const Eigen::MatrixXd& x)
    { return x.colwise().squaredNorm().unaryExpr([](double d) { return std::log1p(d); }).eval(); };
    values.colwise() += fromOrigin(a).transpose();
    values.rowwise() += fromOrigin(b);
  }
  return values;
}

KernelEstimator::KernelEstimator(const NamedMatrices& parameters)
{
  Points = requireMatrix(parameters, "kernel.points", AnySize, AnySize, KernelOwner);
  const Eigen::MatrixXd& channels =
    requireMatrix(parameters, "kernel.channels", Points.rows(), 2, KernelOwner);
  const Eigen::MatrixXd& coefficients =
    requireMatrix(parameters, "kernel.coefficients", Points.cols(), AnySize, KernelOwner);
  Constant = requireMatrix(parameters, "kernel.constant", coefficients.cols(), 1, KernelOwner);
  const double kind = requireMatrix(parameters, "kernel.kind", 1, 1, KernelOwner)(0, 0);
  if (kind != 0.0 && kind != 1.0)
  {
    throw std::invalid_argument(
      "matrix 'kernel.kind' of " + KernelOwner + " is neither 0 (Gaussian) nor 1 (logarithmic)");
  }
  Kernel = kind == 0.0 ? RegressionKernel::Gaussian : RegressionKernel::Logarithmic;
  Scale = channels.col(0);
  Offset = channels.col(1);
  Transposed = coefficients.transpose();
  Parameters = { { "kernel.kind", Eigen::MatrixXd::Constant(1, 1, kind) },
    { "kernel.channels", channels }, { "kernel.points", Points },
    { "kernel.coefficients", coefficients }, { "kernel.constant", Constant } };
}

void KernelEstimator::apply(const double* response, double* mean, double* /*standardDeviation*/,
  Eigen::Index pixels) const noexcept
{
  Eigen::VectorXd feature(channels());
  Eigen::VectorXd sum(bands());
  for (Eigen::Index pixel = 0; pixel < pixels; ++pixel)
  {
    feature = Eigen::Map<const Eigen::VectorXd>(response + pixel * channels(), channels());
    feature = (Scale.array() * feature.array() - Offset.array()).matrix();
    // The terms log(1 + |x|^2) and log(1 + |p|^2) of the completed kernel are in the constant: the
    // coefficients of a band add up to zero.
    sum = Constant;
    for (Eigen::Index j = 0; j < Points.cols(); ++j)
    {
      sum += kernelValue(Kernel, (Points.col(j) - feature).squaredNorm()) * Transposed.col(j);
    }
    Eigen::Map<Eigen::VectorXd>(mean + pixel * bands(), bands()) = sum;
  }
}

} // namespace msi

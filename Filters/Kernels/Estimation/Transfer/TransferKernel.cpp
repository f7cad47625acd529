#include "Kernels/Estimation/Transfer/TransferKernel.h"

namespace msi
{

namespace
{
using Kernel = TransferKernel;
}

TransferKernel startingKernel()
{
  Eigen::VectorXd center(Kernel::Count);
  center[Kernel::Constant] = 0.0;
  center[Kernel::Linear] = 0.0;
  center[Kernel::Smooth] = -2.0;
  center[Kernel::Length] = 0.0;
  center[Kernel::TargetConstant] = -4.0;
  center[Kernel::TargetLinear] = -4.0;
  center[Kernel::TargetSmooth] = -4.0;
  center[Kernel::ChartNoise] = -5.0;
  center[Kernel::TargetNoise] = -5.0;
  return { center };
}

Eigen::MatrixXd scaledProducts(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return a.transpose() * b / static_cast<double>(a.rows());
}

Eigen::MatrixXd scaledDistances(
  const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& products)
{
  const double channels = static_cast<double>(a.rows());
  const Eigen::VectorXd ofA = a.colwise().squaredNorm().transpose() / channels;
  const Eigen::RowVectorXd ofB = b.colwise().squaredNorm() / channels;
  Eigen::MatrixXd distances = -2.0 * products;
  distances.colwise() += ofA;
  distances.rowwise() += ofB;
  return distances.cwiseMax(0.0);
}

Eigen::MatrixXd covariance(const TransferKernel& kernel, const Eigen::MatrixXd& a,
  Eigen::Index chartOfA, const Eigen::MatrixXd& b, Eigen::Index chartOfB)
{
  const Eigen::MatrixXd products = scaledProducts(a, b);
  const double length = kernel[Kernel::Length];
  const Eigen::MatrixXd smooth =
    (scaledDistances(a, b, products).array() * (-0.5 / (length * length))).exp();
  Eigen::MatrixXd result = (kernel[Kernel::Constant] + kernel[Kernel::Linear] * products.array() +
    kernel[Kernel::Smooth] * smooth.array())
                             .matrix();
  const Eigen::Index targetOfA = a.cols() - chartOfA;
  const Eigen::Index targetOfB = b.cols() - chartOfB;
  result.bottomRightCorner(targetOfA, targetOfB).array() += kernel[Kernel::TargetConstant] +
    kernel[Kernel::TargetLinear] * products.bottomRightCorner(targetOfA, targetOfB).array() +
    kernel[Kernel::TargetSmooth] * smooth.bottomRightCorner(targetOfA, targetOfB).array();
  return result;
}

} // namespace msi

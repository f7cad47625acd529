#include "Kernels/Difference/CIE76.h"

#include <cmath>

namespace msi
{

namespace
{
// In double, and in one order whatever the compiler makes of a block.
template <typename Scalar>
double distance(const Scalar* lab1, const Scalar* lab2) noexcept
{
  const double l = static_cast<double>(lab2[0]) - static_cast<double>(lab1[0]);
  const double a = static_cast<double>(lab2[1]) - static_cast<double>(lab1[1]);
  const double b = static_cast<double>(lab2[2]) - static_cast<double>(lab1[2]);
  return std::sqrt(l * l + a * a + b * b);
}

template <typename Scalar>
void distances(const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& lab1,
  const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& lab2,
  Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>& difference) noexcept
{
  for (Eigen::Index i = 0; i < difference.size(); ++i)
  {
    difference(i) = static_cast<Scalar>(distance(lab1.col(i).data(), lab2.col(i).data()));
  }
}
}

double deltaE76(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) noexcept
{
  return distance(lab1.data(), lab2.data());
}

void deltaE76(const Eigen::Ref<const Eigen::Matrix3Xd>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xd>& lab2, Eigen::Ref<Eigen::VectorXd> difference) noexcept
{
  distances<double>(lab1, lab2, difference);
}

void deltaE76(const Eigen::Ref<const Eigen::Matrix3Xf>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xf>& lab2, Eigen::Ref<Eigen::VectorXf> difference) noexcept
{
  distances<float>(lab1, lab2, difference);
}

} // namespace msi

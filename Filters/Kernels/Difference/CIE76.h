// The CIE 1976 color difference.
#pragma once

#include <Eigen/Core>

namespace msi
{

// Delta E*ab: the Euclidean distance in CIELAB. Source: ISO/CIE 11664-4:2019.
double deltaE76(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) noexcept;

// Block calls, for shapes already checked: three blocks of as many columns.
void deltaE76(const Eigen::Ref<const Eigen::Matrix3Xd>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xd>& lab2, Eigen::Ref<Eigen::VectorXd> difference) noexcept;
void deltaE76(const Eigen::Ref<const Eigen::Matrix3Xf>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xf>& lab2, Eigen::Ref<Eigen::VectorXf> difference) noexcept;

} // namespace msi

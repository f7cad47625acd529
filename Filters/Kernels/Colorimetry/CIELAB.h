// The CIE 1976 L*a*b* color space.
#pragma once

#include <Eigen/Core>

namespace msi
{

// XYZ to and from L*a*b*, with respect to one white point.
//
// Source: ISO/CIE 11664-4:2019, with the exact rational constants 6/29 and 16/116.
// Shape:  3 x samples; a sample is a column.
// Ranges: all finite XYZ, also negative ones: the linear branch goes on below zero.
// Errors: the constructor throws std::invalid_argument unless the white point is finite and positive.
class CIELAB
{
public:
  explicit CIELAB(const Eigen::Vector3d& whitePoint);

  const Eigen::Vector3d& whitePoint() const noexcept { return WhitePoint; }

  Eigen::Vector3d fromXYZ(const Eigen::Vector3d& xyz) const noexcept;
  Eigen::Vector3d toXYZ(const Eigen::Vector3d& lab) const noexcept;

  // Block calls, for shapes already checked: as many columns out as in. In place is allowed.
  void fromXYZ(
    const Eigen::Ref<const Eigen::Matrix3Xd>& xyz, Eigen::Ref<Eigen::Matrix3Xd> lab) const noexcept;
  void fromXYZ(
    const Eigen::Ref<const Eigen::Matrix3Xf>& xyz, Eigen::Ref<Eigen::Matrix3Xf> lab) const noexcept;
  void toXYZ(
    const Eigen::Ref<const Eigen::Matrix3Xd>& lab, Eigen::Ref<Eigen::Matrix3Xd> xyz) const noexcept;

private:
  Eigen::Vector3d WhitePoint;
};

// L*, chroma C*ab and hue angle hab in degrees, [0, 360); hue 0 where chroma is 0.
Eigen::Vector3d labToLch(const Eigen::Vector3d& lab) noexcept;
Eigen::Vector3d lchToLab(const Eigen::Vector3d& lch) noexcept;

} // namespace msi

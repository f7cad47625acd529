#include "Kernels/Colorimetry/CIELAB.h"

#include "Kernels/Colorimetry/ColorBlocks.h"
#include "Kernels/Colorimetry/WhitePoint.h"

#include <cmath>
#include <cstddef>

namespace msi
{

namespace
{
constexpr double Delta = 6.0 / 29.0;
constexpr double Degree = 0.017453292519943295;

double expand(double f) noexcept
{
  return f > Delta ? f * f * f : 3.0 * Delta * Delta * (f - 4.0 / 29.0);
}

template <typename Scalar>
void labOfBlock(const Eigen::Vector3d& whitePoint,
  const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& xyz,
  Eigen::Ref<Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& lab) noexcept
{
  if (xyz.outerStride() == 3 && lab.outerStride() == 3)
  {
    labFromXYZ(whitePoint.data(), xyz.data(), lab.data(), static_cast<std::size_t>(xyz.cols()));
    return;
  }
  for (Eigen::Index i = 0; i < xyz.cols(); ++i)
  {
    labFromXYZ(whitePoint.data(), xyz.col(i).data(), lab.col(i).data(), 1);
  }
}
}

CIELAB::CIELAB(const Eigen::Vector3d& whitePoint)
  : WhitePoint(validWhitePoint(whitePoint))
{
}

Eigen::Vector3d CIELAB::fromXYZ(const Eigen::Vector3d& xyz) const noexcept
{
  Eigen::Vector3d lab;
  labFromXYZ(WhitePoint.data(), xyz.data(), lab.data(), 1);
  return lab;
}

Eigen::Vector3d CIELAB::toXYZ(const Eigen::Vector3d& lab) const noexcept
{
  const double y = (lab(0) + 16.0) / 116.0;
  return { WhitePoint(0) * expand(y + lab(1) / 500.0), WhitePoint(1) * expand(y),
    WhitePoint(2) * expand(y - lab(2) / 200.0) };
}

void CIELAB::fromXYZ(
  const Eigen::Ref<const Eigen::Matrix3Xd>& xyz, Eigen::Ref<Eigen::Matrix3Xd> lab) const noexcept
{
  labOfBlock<double>(WhitePoint, xyz, lab);
}

void CIELAB::fromXYZ(
  const Eigen::Ref<const Eigen::Matrix3Xf>& xyz, Eigen::Ref<Eigen::Matrix3Xf> lab) const noexcept
{
  labOfBlock<float>(WhitePoint, xyz, lab);
}

void CIELAB::toXYZ(
  const Eigen::Ref<const Eigen::Matrix3Xd>& lab, Eigen::Ref<Eigen::Matrix3Xd> xyz) const noexcept
{
  for (Eigen::Index i = 0; i < lab.cols(); ++i)
  {
    xyz.col(i) = toXYZ(Eigen::Vector3d(lab.col(i)));
  }
}

Eigen::Vector3d labToLch(const Eigen::Vector3d& lab) noexcept
{
  const double chroma = std::hypot(lab(1), lab(2));
  double hue = chroma == 0.0 ? 0.0 : std::atan2(lab(2), lab(1)) / Degree;
  if (hue < 0.0)
  {
    hue += 360.0;
  }
  // A hue a rounding below zero would come out as 360.
  return { lab(0), chroma, hue >= 360.0 ? 0.0 : hue };
}

Eigen::Vector3d lchToLab(const Eigen::Vector3d& lch) noexcept
{
  return { lch(0), lch(1) * std::cos(lch(2) * Degree), lch(1) * std::sin(lch(2) * Degree) };
}

} // namespace msi

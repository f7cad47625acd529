#include "Kernels/Colorimetry/SRGB.h"

#include "Kernels/Colorimetry/ColorBlocks.h"
#include "Kernels/Colorimetry/WhitePoint.h"

#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace msi
{

namespace
{

Eigen::Vector3d fromChromaticity(double x, double y)
{
  return { x / y, 1.0, (1.0 - x - y) / y };
}

// Linear RGB to XYZ, Y = 1 for white: the primaries, scaled so that their sum is the white.
Eigen::Matrix3d primaries(DisplaySpace display, const Eigen::Vector3d& white)
{
  Eigen::Matrix3d columns;
  if (display == DisplaySpace::SRGB)
  {
    columns << fromChromaticity(0.64, 0.33), fromChromaticity(0.30, 0.60),
      fromChromaticity(0.15, 0.06);
  }
  else
  {
    columns << fromChromaticity(0.680, 0.320), fromChromaticity(0.265, 0.690),
      fromChromaticity(0.150, 0.060);
  }
  return columns * (columns.inverse() * white).asDiagonal();
}

template <typename Scalar>
SRGBClipping sRGBOfBlock(const Eigen::Matrix3d& linearMatrix,
  const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& xyz,
  Eigen::Ref<Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& rgb) noexcept
{
  if (xyz.outerStride() == 3 && rgb.outerStride() == 3)
  {
    return sRGBFromXYZ(
      linearMatrix.data(), xyz.data(), rgb.data(), static_cast<std::size_t>(xyz.cols()));
  }
  SRGBClipping clipping;
  for (Eigen::Index i = 0; i < xyz.cols(); ++i)
  {
    clipping += sRGBFromXYZ(linearMatrix.data(), xyz.col(i).data(), rgb.col(i).data(), 1);
  }
  return clipping;
}
}

std::vector<std::string> displaySpaceNames()
{
  return { "sRGB", "Display P3" };
}

DisplaySpace displaySpaceNamed(std::string_view name)
{
  if (name == "sRGB")
  {
    return DisplaySpace::SRGB;
  }
  if (name == "Display P3")
  {
    return DisplaySpace::DisplayP3;
  }
  throw std::invalid_argument(
    "there is no display space '" + std::string(name) + "'; expected sRGB or Display P3");
}

SRGB::SRGB(const Eigen::Vector3d& whitePoint, DisplaySpace display, ChromaticAdaptation adaptation)
{
  const Eigen::Vector3d source = validWhitePoint(whitePoint) / WhiteY;
  const Eigen::Vector3d d65 = fromChromaticity(0.3127, 0.3290);
  LinearMatrix =
    primaries(display, d65).inverse() * adaptationMatrix(adaptation, source, d65) / WhiteY;
}

bool SRGB::isOutOfGamut(const Eigen::Vector3d& xyz) const noexcept
{
  const Eigen::Array3d linear = LinearMatrix * xyz;
  return linear.isFinite().all() &&
    (linear < -SRGBGamutTolerance || linear > 1.0 + SRGBGamutTolerance).any();
}

SRGBClipping SRGB::apply(
  const Eigen::Ref<const Eigen::Matrix3Xd>& xyz, Eigen::Ref<Eigen::Matrix3Xd> rgb) const noexcept
{
  return sRGBOfBlock<double>(LinearMatrix, xyz, rgb);
}

SRGBClipping SRGB::apply(
  const Eigen::Ref<const Eigen::Matrix3Xf>& xyz, Eigen::Ref<Eigen::Matrix3Xf> rgb) const noexcept
{
  return sRGBOfBlock<float>(LinearMatrix, xyz, rgb);
}

double SRGB::encode(double linear) noexcept
{
  return linear > 0.0031308 ? 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055 : 12.92 * linear;
}

double SRGB::decode(double encoded) noexcept
{
  return encoded > 0.04045 ? std::pow((encoded + 0.055) / 1.055, 2.4) : encoded / 12.92;
}

} // namespace msi

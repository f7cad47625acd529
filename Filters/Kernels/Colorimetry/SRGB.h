// Tristimulus values as sRGB, for display.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace msi
{

// What did not fit into sRGB.
struct SRGBClipping
{
  std::int64_t outOfGamut = 0; // samples with a channel below 0 or above 1, which was clipped
  std::int64_t notFinite = 0;  // samples with a NaN or infinity; written as NaN

  SRGBClipping& operator+=(const SRGBClipping& other) noexcept
  {
    outOfGamut += other.outOfGamut;
    notFinite += other.notFinite;
    return *this;
  }
};

// XYZ under any white point, Y = 100 for white, to gamma-encoded sRGB.
//
// Source: IEC 61966-2-1:1999 (primaries, white D65 at x 0.3127, y 0.3290, encoding); the white is
//         adapted with the linear Bradford transform (ICC.1:2022, annex E). The white point given
//         maps to (1, 1, 1).
// Shape:  3 x samples; a sample is a column.
// Units:  out 0..1. A channel beyond -1e-6..1+1e-6 before clipping counts as out of gamut.
// Errors: the constructor throws std::invalid_argument unless the white point is finite and positive.
class SRGB
{
public:
  explicit SRGB(const Eigen::Vector3d& whitePoint);

  // XYZ, Y = 100 for white, to linear RGB; adaptation included.
  const Eigen::Matrix3d& linearMatrix() const noexcept { return LinearMatrix; }

  // Block calls, for shapes already checked: as many columns out as in. In place is allowed.
  SRGBClipping apply(
    const Eigen::Ref<const Eigen::Matrix3Xd>& xyz, Eigen::Ref<Eigen::Matrix3Xd> rgb) const noexcept;
  SRGBClipping apply(
    const Eigen::Ref<const Eigen::Matrix3Xf>& xyz, Eigen::Ref<Eigen::Matrix3Xf> rgb) const noexcept;

  // The transfer function of one channel and its inverse, for 0..1.
  static double encode(double linear) noexcept;
  static double decode(double encoded) noexcept;

private:
  Eigen::Matrix3d LinearMatrix;
};

} // namespace msi

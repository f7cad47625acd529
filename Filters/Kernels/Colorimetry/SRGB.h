// Tristimulus values as sRGB or Display P3, for display.
#pragma once

#include "Kernels/Colorimetry/ChromaticAdaptation.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

// The colors that a display shows. Both have the white D65 and the encoding of sRGB.
enum class DisplaySpace
{
  SRGB,     // IEC 61966-2-1:1999
  DisplayP3 // the primaries of SMPTE EG 432-1 (P3)
};

// "sRGB", "Display P3". displaySpaceNamed throws std::invalid_argument listing the names.
std::vector<std::string> displaySpaceNames();
DisplaySpace displaySpaceNamed(std::string_view name);

// What did not fit into the display's colors.
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

// XYZ under any white point, Y = 100 for white, to gamma-encoded sRGB or Display P3.
//
// Source: IEC 61966-2-1:1999 (primaries, white D65 at x 0.3127, y 0.3290, encoding); the white is
//         adapted as ChromaticAdaptation.h says. The white point given maps to (1, 1, 1).
// Shape:  3 x samples; a sample is a column.
// Units:  out 0..1. A channel beyond -1e-6..1+1e-6 before clipping counts as out of gamut.
// Errors: the constructor throws std::invalid_argument unless the white point is finite and positive.
class SRGB
{
public:
  explicit SRGB(const Eigen::Vector3d& whitePoint, DisplaySpace display = DisplaySpace::SRGB,
    ChromaticAdaptation adaptation = ChromaticAdaptation::Bradford);

  // XYZ, Y = 100 for white, to linear RGB; adaptation included.
  const Eigen::Matrix3d& linearMatrix() const noexcept { return LinearMatrix; }

  // Block calls, for shapes already checked: as many columns out as in. In place is allowed.
  SRGBClipping apply(
    const Eigen::Ref<const Eigen::Matrix3Xd>& xyz, Eigen::Ref<Eigen::Matrix3Xd> rgb) const noexcept;
  SRGBClipping apply(
    const Eigen::Ref<const Eigen::Matrix3Xf>& xyz, Eigen::Ref<Eigen::Matrix3Xf> rgb) const noexcept;

  // Whether a color has a channel outside of the display's range, as apply() counts it; false with a NaN.
  bool isOutOfGamut(const Eigen::Vector3d& xyz) const noexcept;

  // The transfer function of one channel and its inverse, for 0..1.
  static double encode(double linear) noexcept;
  static double decode(double encoded) noexcept;

private:
  Eigen::Matrix3d LinearMatrix;
};

} // namespace msi

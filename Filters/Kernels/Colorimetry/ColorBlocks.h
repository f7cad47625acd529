// The SIMD block kernels behind CIELAB and SRGB: contiguous colors, three values each.
#pragma once

#include "Kernels/Colorimetry/SRGB.h"

#include <cstddef>

namespace msi
{

// A channel beyond 0..1 by more than this is out of gamut.
inline constexpr double SRGBGamutTolerance = 1e-6;

// In and out may be the same. Defined for float and double.
template <typename Scalar>
void labFromXYZ(
  const double* whitePoint, const Scalar* xyz, Scalar* lab, std::size_t count) noexcept;

// Computed in float throughout: each of the three ratios to white, and so each cube root, is off by at most 2e-7 of itself.
void labFromXYZInFloat(
  const double* whitePoint, const float* xyz, float* lab, std::size_t count) noexcept;

// linearMatrix by columns.
template <typename Scalar>
SRGBClipping sRGBFromXYZ(
  const double* linearMatrix, const Scalar* xyz, Scalar* rgb, std::size_t count) noexcept;

} // namespace msi

// The SIMD block kernel behind CIEDE2000.
#pragma once

#include "Kernels/Difference/CIEDE2000.h"

#include <cstddef>

namespace msi
{

// Contiguous colors, three values each. Defined for float and double.
template <typename Scalar>
void differencesCIEDE2000(const CIEDE2000Factors& factors, const Scalar* lab1, const Scalar* lab2,
  Scalar* difference, std::size_t count) noexcept;

// From XYZ, through labFromXYZInFloat, to the difference from 'lab': the same bytes as in two steps. X of all colors, from
// planeStride on their Y, then Z; planes have room for a multiple of 16 colors.
void differencesFromXYZ(const CIEDE2000Factors& factors, const double* whitePoint, const float* lab,
  const float* xyz, std::size_t planeStride, float* difference, std::size_t count) noexcept;

} // namespace msi

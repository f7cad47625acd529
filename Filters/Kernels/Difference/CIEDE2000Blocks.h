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

} // namespace msi

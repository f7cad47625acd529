// Inner loops of the detector's curves.
#pragma once

#include <cstddef>

namespace msi
{

// In place. SIMD chosen at run time (Highway): the bytes of a value depend on no other.
// Powers: values not above zero stay; against the exact result the relative error is at most 1e-14 times
// 1 + |exponent ln(value)|.

// u -> u^exponent
void raise(double exponent, double* values, std::size_t count) noexcept;

// u -> u / (1 + (u / level)^sharpness)^(1 / sharpness); level, sharpness > 0.
void saturateGradually(double level, double sharpness, double* values, std::size_t count) noexcept;

// u -> (u + level - sqrt((u - level)^2 + width2)) / 2, the bytes of a plain loop.
void saturate(float level, float width2, float* values, std::size_t count) noexcept;

} // namespace msi

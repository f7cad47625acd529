// The inner loop of the effect saturation, single precision.
#pragma once

#include <cstddef>

namespace msi
{

// u -> (u + level - sqrt((u - level)^2 + width2)) / 2, in place. SIMD chosen at run time (Highway); the bytes of a
// plain loop.
void saturate(float level, float width2, float* values, std::size_t count) noexcept;

} // namespace msi

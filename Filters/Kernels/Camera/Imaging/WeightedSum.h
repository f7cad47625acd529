// The inner loops of the image filters.
#pragma once

#include <cstddef>

namespace msi
{

// Per value out = weight 0 x self + weight 1 x (before 1 + after 1) + ..., in this order; before[0] and after[0]
// are not read. The weights of tap t are weights[t * period], ..., one for each value of a period, over and over; a period
// of 1 is one weight for all.
// SIMD chosen at run time (Highway); no fused operation: the bytes of a plain loop. `out` must not overlap the rest.
void symmetricSum(const float* weights, std::size_t period, const float* self,
  const float* const* before, const float* const* after, std::size_t taps, float* out,
  std::size_t count) noexcept;

// Per value out = weight 0 x source 0 + weight 1 x source 1 + ..., in this order; weights as above, but those of tap t
// begin at weights[t * step].
void weightedSum(const float* weights, std::size_t step, std::size_t period,
  const float* const* sources, std::size_t taps, float* out, std::size_t count) noexcept;

// sum += weight x values.
void addScaled(float weight, const float* values, float* sum, std::size_t count) noexcept;

} // namespace msi

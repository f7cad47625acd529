// The inner loop of NoiseGenerator, single precision.
#pragma once

#include <cstddef>

namespace msi
{

// What falls on the values of a chunk. A null pointer or a zero step: that part draws nothing and changes no bit.
struct NoiseTerms
{
  const float* gainPattern = nullptr; // deviates
  float gain = 0.0F;
  const float* offsetPattern = nullptr;
  float offset = 0.0F;
  const float* temporal = nullptr;
  const float* factor = nullptr; // on the temporal standard deviation, one a value
  float readVariance = 0.0F;
  float shotVariance = 0.0F; // at white
  float step = 0.0F;
};

// In place. SIMD chosen at run time (Highway); what CameraNoise.cpp does in double precision.
void addNoise(const NoiseTerms& terms, float* values, std::size_t count) noexcept;

} // namespace msi

// From bands that lie apart in memory to pixels: the inner loop of every image reader.
#pragma once

#include "Formats/SampleType.h"

#include <cstddef>
#include <vector>

namespace msi
{

// What happens to a stored value on its way: value == ignoreValue ? NaN : value / divisor.
struct SampleConversion
{
  double divisor = 1.0;
  bool hasIgnoreValue = false;
  double ignoreValue = 0.0; // compared as stored: -3.4e38 means the float next to it
  bool swapBytes = false;
};

// The samples of one band along one row; perhaps not aligned.
struct BandRow
{
  const unsigned char* samples;
  std::ptrdiff_t stride; // bytes from one pixel to the next
};

// Writes pixels[x * bands.size() + b] for 'width' pixels. Cache-blocked: a tile of pixels is finished
// for all bands while it lies in the first-level cache. Integers of 64 bits are rounded to the nearest
// number of the target, as are doubles for float.
void interleaveRow(SampleType stored, const std::vector<BandRow>& bands, std::size_t width,
  const SampleConversion& conversion, float* pixels) noexcept;
void interleaveRow(SampleType stored, const std::vector<BandRow>& bands, std::size_t width,
  const SampleConversion& conversion, double* pixels) noexcept;

} // namespace msi

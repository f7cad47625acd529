// From pixels to stored samples: the inner loop of the ENVI writer.
#pragma once

#include "Formats/SampleType.h"

#include <cstddef>
#include <optional>
#include <string>

namespace msi
{

// What happens to a value on its way: NaN -> ignoreValue, else value * factor, rounded to nearest (half
// to even) for integers.
struct SampleEncoding
{
  SampleType type = SampleType::Float32;
  double factor = 1.0;
  std::optional<double> ignoreValue;
  bool swapBytes = false;
};

// 'count' values, 'valueStride' apart, into samples 'sampleStride' bytes apart. Returns what is wrong
// with the first value that the type cannot hold, or nothing.
std::optional<std::string> encodeSamples(const SampleEncoding& encoding, const float* values,
  std::ptrdiff_t valueStride, std::size_t count, unsigned char* samples,
  std::ptrdiff_t sampleStride);
std::optional<std::string> encodeSamples(const SampleEncoding& encoding, const double* values,
  std::ptrdiff_t valueStride, std::size_t count, unsigned char* samples,
  std::ptrdiff_t sampleStride);

} // namespace msi

#include "Kernels/Camera/Imaging/SceneMean.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double Largest = 0x1p20;
// So many terms of at most 2^11 in size, multiples of 2^-32, have sums that a double holds exactly.
constexpr int PartPixels = 1024;
constexpr double LargestInPart = 0x1p11;

// The nearest multiple of 2^-32, for sizes below 2^19.
double rounded(double value) noexcept
{
  constexpr double Shift = 0x1.8p20;
  return (value + Shift) - Shift;
}
}

void SceneMean::add(const float* pixels, int count) noexcept
{
  const std::size_t channels = Sums.size();
  for (int first = 0; first < count; first += PartPixels)
  {
    const int pixelsOfPart = std::min(PartPixels, count - first);
    const float* part = pixels + static_cast<std::size_t>(first) * channels;
    std::fill(PartSums.begin(), PartSums.end(), 0.0);
    std::fill(PartCounts.begin(), PartCounts.end(), 0);
    for (int i = 0; i < pixelsOfPart; ++i, part += channels)
    {
      for (std::size_t k = 0; k < channels; ++k)
      {
        const double value = part[k];
        const bool small = std::abs(value) < LargestInPart;
        PartSums[k] += small ? rounded(value) : 0.0;
        PartCounts[k] += small ? 1 : 0;
      }
    }
    for (std::size_t k = 0; k < channels; ++k)
    {
      Sums[k].add(PartSums[k]);
      Counts[k] += PartCounts[k];
      if (PartCounts[k] < pixelsOfPart)
      {
        // A single precision value of that size is a multiple of 2^-32 already.
        const float* values = pixels + static_cast<std::size_t>(first) * channels + k;
        for (int i = 0; i < pixelsOfPart; ++i, values += channels)
        {
          const double value = *values;
          if (std::abs(value) >= LargestInPart && std::abs(value) < Largest)
          {
            Sums[k].add(value);
            ++Counts[k];
          }
        }
      }
    }
  }
}

} // namespace msi

#include "Kernels/Camera/Imaging/RowConvolution.h"

#include "Kernels/Camera/Imaging/WeightedSum.h"

#include <algorithm>

namespace msi
{

namespace
{
// The kernel's weights are repeated over so many pixels that a loop over them is worth its start.
constexpr std::size_t TilePixels = 32;

// A row with its first and last pixel repeated `margin` times.
void padRow(const float* row, std::size_t pixels, std::size_t channels, std::size_t margin,
  std::vector<float>& padded)
{
  padded.resize((pixels + 2 * margin) * channels);
  float* out = padded.data();
  for (std::size_t i = 0; i < margin; ++i, out += channels)
  {
    std::copy_n(row, channels, out);
  }
  out = std::copy_n(row, pixels * channels, out);
  for (std::size_t i = 0; i < margin; ++i, out += channels)
  {
    std::copy_n(row + (pixels - 1) * channels, channels, out);
  }
}
}

void RowConvolution::begin(const SymmetricKernel& kernel, int width, int height)
{
  Channels = static_cast<std::size_t>(kernel.weights.rows());
  Taps = static_cast<std::size_t>(kernel.weights.cols());
  Period = TilePixels * Channels;
  Weights.clear();
  for (Eigen::Index tap = 0; tap < kernel.weights.cols(); ++tap)
  {
    const float* weight = kernel.weights.col(tap).data();
    for (std::size_t pixel = 0; pixel < TilePixels; ++pixel)
    {
      Weights.insert(Weights.end(), weight, weight + Channels);
    }
  }
  Stride = kernel.stride;
  Radius = kernel.radius();
  Count = static_cast<std::size_t>(width) * Channels;
  Height = height;
  Taken = 0;
  Given = 0;
  Span = std::min(2 * Radius + 1, height);
  Ring.resize(static_cast<std::size_t>(Span) * Count);
  Out.resize(Count);
  Before.resize(Taps);
  After.resize(Taps);
}

void RowConvolution::take(const float* row)
{
  const auto margin = static_cast<std::size_t>(Radius);
  padRow(row, Count / Channels, Channels, margin, Padded);
  const float* self = Padded.data() + margin * Channels;
  for (std::size_t tap = 1; tap < Taps; ++tap)
  {
    const std::size_t step = tap * static_cast<std::size_t>(Stride) * Channels;
    Before[tap] = self - step;
    After[tap] = self + step;
  }
  symmetricSum(
    Weights.data(), Period, self, Before.data(), After.data(), Taps, inRing(Taken), Count);
  ++Taken;
}

const float* RowConvolution::next()
{
  for (std::size_t tap = 1; tap < Taps; ++tap)
  {
    const int step = static_cast<int>(tap) * Stride;
    Before[tap] = inRing(std::max(Given - step, 0));
    After[tap] = inRing(std::min(Given + step, Height - 1));
  }
  symmetricSum(
    Weights.data(), Period, inRing(Given), Before.data(), After.data(), Taps, Out.data(), Count);
  ++Given;
  return Out.data();
}

} // namespace msi

#include "Kernels/Camera/Imaging/RowConvolution.h"

#include "Kernels/Camera/Imaging/WeightedSum.h"

#include <algorithm>

namespace msi
{

namespace
{
// The kernel's weights are repeated over so many pixels that a loop over them is worth its start.
constexpr std::size_t TilePixels = 32;
}

void RowConvolution::begin(const SymmetricKernel& kernel, int width, int height)
{
  Channels = static_cast<std::size_t>(kernel.weights.rows());
  Taps = static_cast<std::size_t>(kernel.weights.cols());
  const bool same = (kernel.weights.rowwise() - kernel.weights.row(0) == 0.0F).all();
  Period = same ? 1 : TilePixels * Channels;
  Weights.clear();
  for (Eigen::Index tap = 0; tap < kernel.weights.cols(); ++tap)
  {
    const float* weight = kernel.weights.col(tap).data();
    for (std::size_t i = 0; i < Period; ++i)
    {
      Weights.push_back(weight[i % Channels]);
    }
  }
  Stride = kernel.stride;
  Radius = kernel.radius();
  Count = static_cast<std::size_t>(width) * Channels;
  Height = height;
  Taken = 0;
  Given = 0;
  Ring.begin(std::min(2 * Radius + 1, height), Count);
  Out.resize(Count);
  Before.resize(Taps);
  After.resize(Taps);
}

void RowConvolution::take(const float* row)
{
  const std::size_t pixels = Count / Channels;
  const auto margin = static_cast<std::size_t>(Radius);
  float* out = Ring.row(Taken);
  ++Taken;
  if (pixels <= 4 * margin)
  {
    padRow(row, pixels, Channels, margin, Padded);
    alongRow(Padded.data() + margin * Channels, out, pixels);
    return;
  }
  // The ends need the edge repeated, the middle does not.
  const std::size_t inner = pixels - 2 * margin;
  alongRow(row + margin * Channels, out + margin * Channels, inner);
  padRow(row, 2 * margin, Channels, margin, Padded);
  alongRow(Padded.data() + margin * Channels, out, margin);
  padRow(row + inner * Channels, 2 * margin, Channels, margin, Padded);
  alongRow(Padded.data() + 2 * margin * Channels, out + (margin + inner) * Channels, margin);
}

// Pixels of a row around which the kernel's reach can be read. The weights' period begins with any pixel.
void RowConvolution::alongRow(const float* self, float* out, std::size_t pixels)
{
  for (std::size_t tap = 1; tap < Taps; ++tap)
  {
    const std::size_t step = tap * static_cast<std::size_t>(Stride) * Channels;
    Before[tap] = self - step;
    After[tap] = self + step;
  }
  symmetricSum(
    Weights.data(), Period, self, Before.data(), After.data(), Taps, out, pixels * Channels);
}

const float* RowConvolution::next()
{
  for (std::size_t tap = 1; tap < Taps; ++tap)
  {
    const int step = static_cast<int>(tap) * Stride;
    Before[tap] = Ring.row(std::max(Given - step, 0));
    After[tap] = Ring.row(std::min(Given + step, Height - 1));
  }
  symmetricSum(
    Weights.data(), Period, Ring.row(Given), Before.data(), After.data(), Taps, Out.data(), Count);
  ++Given;
  return Out.data();
}

} // namespace msi

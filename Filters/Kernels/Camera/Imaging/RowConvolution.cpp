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
  Ring.begin(std::min(2 * Radius + 1, height), Count);
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
    Weights.data(), Period, self, Before.data(), After.data(), Taps, Ring.row(Taken), Count);
  ++Taken;
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

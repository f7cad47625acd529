#include "Kernels/Camera/Imaging/SeparableFilter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace msi
{

namespace
{
constexpr double GaussianCut = 4.0;

// The kernel's weights repeated over so many pixels that a loop over them is worth its start.
class RepeatedWeights
{
public:
  explicit RepeatedWeights(const SymmetricKernel& kernel)
    : Length(TilePixels * static_cast<std::size_t>(kernel.weights.rows()))
  {
    for (Eigen::Index i = 0; i < kernel.weights.cols(); ++i)
    {
      for (std::size_t pixel = 0; pixel < TilePixels; ++pixel)
      {
        const float* weight = kernel.weights.col(i).data();
        Values.insert(Values.end(), weight, weight + kernel.weights.rows());
      }
    }
  }

  // out = weight 0 x self + sum of weight i x (before i + after i); before[0] and after[0] are not read.
  void apply(const float* self, const std::vector<const float*>& before,
    const std::vector<const float*>& after, float* out, std::size_t count) const noexcept
  {
    for (std::size_t first = 0; first < count; first += Length)
    {
      const std::size_t tile = std::min(Length, count - first);
      const float* weight = Values.data();
      for (std::size_t i = 0; i < tile; ++i)
      {
        out[first + i] = weight[i] * self[first + i];
      }
      for (std::size_t tap = 1; tap < before.size(); ++tap)
      {
        weight += Length;
        const float* a = before[tap] + first;
        const float* b = after[tap] + first;
        for (std::size_t i = 0; i < tile; ++i)
        {
          out[first + i] += weight[i] * (a[i] + b[i]);
        }
      }
    }
  }

private:
  static constexpr std::size_t TilePixels = 32;

  std::size_t Length;
  std::vector<float> Values;
};

// A row with its first and last pixel repeated `margin` times.
void pad(const float* row, std::size_t pixels, std::size_t channels, std::size_t margin,
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

SymmetricKernel gaussianKernel(const Eigen::ArrayXd& deviations)
{
  const double widest = deviations.size() > 0 ? deviations.maxCoeff() : 0.0;
  const auto reach = static_cast<Eigen::Index>(std::ceil(GaussianCut * widest));
  Eigen::ArrayXXd weights = Eigen::ArrayXXd::Zero(deviations.size(), reach + 1);
  weights.col(0).setOnes();
  for (Eigen::Index k = 0; k < deviations.size(); ++k)
  {
    if (deviations[k] > 0.0)
    {
      const double cut = GaussianCut * deviations[k];
      for (Eigen::Index i = 0; i <= reach; ++i)
      {
        const double t = static_cast<double>(i) / deviations[k];
        weights(k, i) = static_cast<double>(i) <= cut ? std::exp(-0.5 * t * t) : 0.0;
      }
    }
    weights.row(k) /= 2.0 * weights.row(k).sum() - weights(k, 0);
  }
  SymmetricKernel kernel;
  kernel.weights = weights.cast<float>();
  return kernel;
}

void convolve(const SymmetricKernel& kernel, PixelBuffer& buffer)
{
  const RepeatedWeights weights(kernel);
  const ImageWindow& window = buffer.window;
  const auto channels = static_cast<std::size_t>(buffer.channels);
  const auto pixels = static_cast<std::size_t>(window.width);
  const std::size_t count = pixels * channels;
  const int radius = kernel.radius();
  const int bottom = window.y + window.height - 1;

  // The rows that a column's kernel spans, convolved along x; a row's place is its number modulo their count.
  const int span = std::min(2 * radius + 1, window.height);
  std::vector<float> ring(static_cast<std::size_t>(span) * count);
  const auto inRing = [&](int y)
  { return ring.data() + static_cast<std::size_t>((y - window.y) % span) * count; };
  const auto taps = static_cast<std::size_t>(kernel.weights.cols());
  std::vector<const float*> before(taps);
  std::vector<const float*> after(taps);
  std::vector<float> padded;
  int next = window.y;
  for (int y = window.y; y <= bottom; ++y)
  {
    for (; next <= std::min(y + radius, bottom); ++next)
    {
      const auto margin = static_cast<std::size_t>(radius);
      pad(buffer.pixel(window.x, next), pixels, channels, margin, padded);
      const float* self = padded.data() + margin * channels;
      for (std::size_t tap = 1; tap < taps; ++tap)
      {
        const std::size_t step = tap * static_cast<std::size_t>(kernel.stride) * channels;
        before[tap] = self - step;
        after[tap] = self + step;
      }
      weights.apply(self, before, after, inRing(next), count);
    }
    for (std::size_t tap = 1; tap < taps; ++tap)
    {
      const int step = static_cast<int>(tap) * kernel.stride;
      before[tap] = inRing(std::max(y - step, window.y));
      after[tap] = inRing(std::min(y + step, bottom));
    }
    weights.apply(inRing(y), before, after, buffer.pixel(window.x, y), count);
  }
}

} // namespace msi

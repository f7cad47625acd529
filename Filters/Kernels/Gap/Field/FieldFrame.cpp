#include "Kernels/Gap/Field/FieldFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace msi
{

namespace
{
constexpr double DarkFrame = 0.25; // of the mean of all

// Numbers of the pixels that are 0 in all channels, from the border on.
std::vector<std::size_t> zerosFromBorder(const FieldPair& pair, const float* image)
{
  const std::size_t K = pair.channels.size();
  const int width = pair.extent.width;
  const int height = pair.extent.height;
  std::vector<char> known(pair.pixels(), 0);
  std::vector<std::size_t> zeros;
  const auto look = [&](int x, int y)
  {
    if (x < 0 || y < 0 || x >= width || y >= height || known[pair.index(x, y)] != 0)
    {
      return;
    }
    const float* values = image + pair.index(x, y) * K;
    if (std::all_of(values, values + K, [](float value) { return value == 0.0F; }))
    {
      known[pair.index(x, y)] = 1;
      zeros.push_back(pair.index(x, y));
    }
  };
  for (int x = 0; x < width; ++x)
  {
    look(x, 0);
    look(x, height - 1);
  }
  for (int y = 0; y < height; ++y)
  {
    look(0, y);
    look(width - 1, y);
  }
  for (std::size_t next = 0; next < zeros.size();)
  {
    const std::size_t pixel = zeros[next++];
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(width));
    const int y = static_cast<int>(pixel / static_cast<std::size_t>(width));
    look(x - 1, y);
    look(x + 1, y);
    look(x, y - 1);
    look(x, y + 1);
  }
  return zeros;
}

class Mean
{
public:
  void add(const float* values, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto value = static_cast<double>(values[i]);
      Sum += std::isfinite(value) ? value : 0.0;
      Count += std::isfinite(value) ? 1.0 : 0.0;
    }
  }
  double value() const { return Sum / std::fmax(Count, 1.0); }

private:
  double Sum = 0.0;
  double Count = 0.0;
};

// Empty where there is none, or where the other image is as dark there.
std::vector<std::size_t> frameOf(const FieldPair& pair, const float* image, const float* other)
{
  std::vector<std::size_t> frame = zerosFromBorder(pair, image);
  const auto side = static_cast<std::size_t>(std::min(pair.extent.width, pair.extent.height));
  if (2 * frame.size() < side || 2 * frame.size() > pair.pixels())
  {
    return {};
  }
  const std::size_t K = pair.channels.size();
  Mean there;
  for (const std::size_t pixel : frame)
  {
    there.add(other + pixel * K, K);
  }
  Mean everywhere;
  everywhere.add(other, pair.pixels() * K);
  return there.value() < DarkFrame * everywhere.value() ? std::vector<std::size_t>{} : frame;
}

std::vector<float> without(
  const std::vector<std::size_t>& frame, const FieldPair& pair, const float* image)
{
  const std::size_t K = pair.channels.size();
  std::vector<float> inside(image, image + pair.pixels() * K);
  for (const std::size_t pixel : frame)
  {
    std::fill_n(inside.begin() + static_cast<std::ptrdiff_t>(pixel * K), K,
      std::numeric_limits<float>::quiet_NaN());
  }
  return inside;
}
}

FramelessPair::FramelessPair(const FieldPair& pair)
  : Pair(pair)
{
  const auto take = [&](std::vector<float>& own, const float*& image, const float* other)
  {
    const std::vector<std::size_t> frame = frameOf(pair, image, other);
    if (!frame.empty())
    {
      own = without(frame, pair, image);
      image = own.data();
      Part += static_cast<double>(frame.size()) / static_cast<double>(pair.pixels());
    }
  };
  take(Real, Pair.real, pair.simulated);
  take(Simulated, Pair.simulated, pair.real);
}

} // namespace msi

// Rectangles of an image, and the pixels in them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace msi
{

struct ImageExtent
{
  int width = 0;
  int height = 0;
};

// Pixels x .. x + width - 1 of the rows y .. y + height - 1.
struct ImageWindow
{
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  std::size_t pixels() const noexcept
  {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool contains(const ImageWindow& other) const noexcept
  {
    return other.x >= x && other.y >= y && other.x + other.width <= x + width &&
      other.y + other.height <= y + height;
  }
};

inline ImageWindow wholeImage(const ImageExtent& extent) noexcept
{
  return { 0, 0, extent.width, extent.height };
}

// The window with a margin on all sides, cut at the image's edges.
inline ImageWindow grown(const ImageWindow& window, int margin, const ImageExtent& extent) noexcept
{
  const int left = std::max(0, window.x - margin);
  const int top = std::max(0, window.y - margin);
  const int right = std::min(extent.width, window.x + window.width + margin);
  const int bottom = std::min(extent.height, window.y + window.height + margin);
  return { left, top, right - left, bottom - top };
}

// Values of a window, pixel after pixel, all channels of a pixel together: the order of a VTK array.
struct PixelBuffer
{
  ImageWindow window;
  int channels = 0;
  std::vector<float> values;

  void resize(const ImageWindow& region, int channelCount)
  {
    window = region;
    channels = channelCount;
    values.resize(region.pixels() * static_cast<std::size_t>(channelCount));
  }
  // A pixel by its place in the image; the place must lie in the window.
  float* pixel(int x, int y) noexcept { return values.data() + offset(x, y); }
  const float* pixel(int x, int y) const noexcept { return values.data() + offset(x, y); }

private:
  std::size_t offset(int x, int y) const noexcept
  {
    return (static_cast<std::size_t>(y - window.y) * static_cast<std::size_t>(window.width) +
             static_cast<std::size_t>(x - window.x)) *
      static_cast<std::size_t>(channels);
  }
};

} // namespace msi

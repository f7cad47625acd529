// A real and a simulated image of the same scene.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

// Responses relative to white, pixel after pixel, all channels of a pixel together. NaN: no value.
// labels: one number a pixel, 0 for none; may be null.
struct FieldPair
{
  ImageExtent extent;
  std::vector<std::string> channels; // K names
  const float* real = nullptr;
  const float* simulated = nullptr;
  const int* labels = nullptr;
  double framePart = 0.0; // of the pixels, in both images: withoutFrame()
  std::vector<std::shared_ptr<const Eigen::MatrixXf>> own = {}; // its images without a frame

  std::size_t pixels() const noexcept { return wholeImage(extent).pixels(); }
  std::size_t index(int x, int y) const noexcept
  {
    return static_cast<std::size_t>(y) * extent.width + x;
  }
  // (x, y) from -1 to 1 over the longer side, from pixel center to pixel center: as ImageSimulator.
  double fieldX(double x) const noexcept { return offX(x) / half(); }
  double fieldY(double y) const noexcept { return offY(y) / half(); }
  // From the middle, in pixels.
  double offX(double x) const noexcept { return x - 0.5 * (extent.width - 1); }
  double offY(double y) const noexcept { return y - 0.5 * (extent.height - 1); }

private:
  double half() const noexcept
  {
    return 0.5 * std::max(1, std::max(extent.width, extent.height) - 1);
  }
};

// So many are enough to look at an image as a whole.
inline constexpr std::size_t MeanPixels = std::size_t(1) << 20;

// Every pixel, or every few of an image of more than MeanPixels, with the cell in which it lies of a raster of width x height:
// visit(x, y, cell), row after row.
template <typename Visit>
void forPixels(const FieldPair& pair, int width, int height, const Visit& visit)
{
  int step = 1;
  while (pair.pixels() / (step * step) > MeanPixels)
  {
    ++step;
  }
  const auto part = [](int place, int parts, int all)
  { return Eigen::Index{ place } * parts / all; };
  for (int y = 0; y < pair.extent.height; y += step)
  {
    const Eigen::Index row = part(y, height, pair.extent.height) * width;
    for (int x = 0; x < pair.extent.width; x += step)
    {
      visit(x, y, row + part(x, width, pair.extent.width));
    }
  }
}

} // namespace msi

// Rectangular patches in rows and columns of a picture.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace msi::scenes
{

using LabelImage = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct PatchLayout
{
  int columns, rows;
  int left, top;               // of the first patch, pixels
  int pitch;                   // from patch to patch, both ways
  int patchWidth, patchHeight; // without the gap
  int width, height;           // of the picture

  struct Place
  {
    int patch;  // 0 between the patches, else 1.. row by row
    int border; // pixels to the patch's nearest edge
    int x, y;   // within the patch; within the picture where Patch is 0
  };

  int count() const noexcept { return columns * rows; }

  Place placeOf(int x, int y) const noexcept
  {
    const int inX = (x - left) % pitch;
    const int inY = (y - top) % pitch;
    const int column = (x - left) / pitch;
    const int row = (y - top) / pitch;
    const bool inside = x >= left && y >= top && column < columns && row < rows &&
      inX < patchWidth && inY < patchHeight;
    if (!inside)
    {
      return { 0, 0, x, y };
    }
    const int border = std::min({ inX, inY, patchWidth - 1 - inX, patchHeight - 1 - inY });
    return { row * columns + column + 1, border, inX, inY };
  }

  // The patch number of every pixel at least `inside` pixels within its edge, 0 elsewhere.
  LabelImage labels(int inside) const
  {
    LabelImage image(height, width);
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        const Place place = placeOf(x, y);
        image(y, x) = static_cast<std::uint8_t>(place.border >= inside ? place.patch : 0);
      }
    }
    return image;
  }
};

// The usual arrangement of a chart: 6 x 4 or 14 x 10 patches with a dark frame around each.
inline PatchLayout chartLayout(int patchCount, int pitch = 16)
{
  if (patchCount != 24 && patchCount != 140)
  {
    throw std::invalid_argument(
      "a printed chart has 24 or 140 patches, not " + std::to_string(patchCount));
  }
  const int columns = patchCount == 24 ? 6 : 14;
  const int rows = patchCount / columns;
  const int gap = std::max(1, pitch / 8);
  return { columns, rows, gap, gap, pitch, pitch - gap, pitch - gap, columns * pitch + gap,
    rows * pitch + gap };
}

} // namespace msi::scenes

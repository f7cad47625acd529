// Images whose values are names of regions: 0 for none, 1, 2, ... for the patches of a chart.
#pragma once

#include "Formats/SpectralImageFile.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

struct LabelImage
{
  int width = 0;
  int height = 0;
  std::vector<std::int32_t> labels; // row by row, top row first
};

// An open label image of one channel; labels are read where they are asked for.
// Errors: FormatError naming the file, for images of several channels, fractional or negative values.
class LabelImageFile
{
public:
  // Every stride-th column and row only.
  explicit LabelImageFile(const std::string& path, int strideX = 1, int strideY = 1);

  int width() const noexcept { return File->info().width; }
  int height() const noexcept { return File->info().height; }
  // Of the file, whatever the stride.
  int wholeHeight() const noexcept { return WholeHeight; }

  // labels[(y - y0) * rowStride + (x - x0)]; rowStride as in SpectralImageFile::readBlock.
  void read(const PixelRegion& region, std::int32_t* labels, std::ptrdiff_t rowStride = 0) const;

private:
  std::string Path;
  std::unique_ptr<SpectralImageFile> File;
  int WholeHeight = 0;
};

// Reads an integer image of one channel, unscaled. Errors: FormatError naming the file, for images of
// several channels, fractional or negative values.
LabelImage readLabelImage(const std::string& path);

} // namespace msi

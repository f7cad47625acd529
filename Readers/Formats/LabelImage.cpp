#include "Formats/LabelImage.h"

#include "Formats/FormatError.h"
#include "Formats/ImageSelection.h"
#include "Formats/SpectralImageFile.h"
#include "Formats/Text/NumberText.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace msi
{

LabelImageFile::LabelImageFile(const std::string& path, int strideX, int strideY)
  : Path(path)
{
  SpectralImageOptions options;
  options.integers = IntegerScaling::Raw;
  options.labels = true;
  File = openSpectralImage(path, options);
  const SpectralImageInfo& info = File->info();
  if (info.bands() != 1)
  {
    throw FormatError(path, "has " + std::to_string(info.bands()) + " channels",
      "a label image of one channel", "save the labels as gray values, without a palette");
  }
  WholeHeight = info.height;
  ImageSelection selection;
  selection.strideX = strideX;
  selection.strideY = strideY;
  File = selectFrom(std::move(File), selection, path);
}

void LabelImageFile::read(
  const PixelRegion& region, std::int32_t* labels, std::ptrdiff_t rowStride) const
{
  std::vector<double> row(static_cast<std::size_t>(region.width()));
  const std::ptrdiff_t stride = rowStride == 0 ? region.width() : rowStride;
  for (int y = region.y0; y < region.y1; ++y)
  {
    File->readBlock({ region.x0, region.x1, y, y + 1 }, {}, row.data());
    std::int32_t* to = labels + (y - region.y0) * stride;
    for (std::size_t x = 0; x < row.size(); ++x)
    {
      const double value = row[x];
      if (!(value >= 0.0 && value <= std::numeric_limits<std::int32_t>::max() &&
            value == std::floor(value)))
      {
        throw FormatError(Path,
          "the pixel in column " + std::to_string(region.x0 + static_cast<int>(x) + 1) +
            " of row " + std::to_string(y + 1) + " is " + numberText(value),
          "whole numbers from 0 up", "name a label image");
      }
      to[x] = static_cast<std::int32_t>(value);
    }
  }
}

LabelImage readLabelImage(const std::string& path)
{
  const LabelImageFile file(path);
  LabelImage image;
  image.width = file.width();
  image.height = file.height();
  image.labels.resize(
    static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  file.read({ 0, image.width, 0, image.height }, image.labels.data());
  return image;
}

} // namespace msi

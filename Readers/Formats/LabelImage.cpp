#include "Formats/LabelImage.h"

#include "Formats/FormatError.h"
#include "Formats/SpectralImageFile.h"
#include "Formats/Text/NumberText.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace msi
{

LabelImage readLabelImage(const std::string& path)
{
  SpectralImageOptions options;
  options.integers = IntegerScaling::Raw;
  const auto file = openSpectralImage(path, options);
  const SpectralImageInfo& info = file->info();
  if (info.bands() != 1)
  {
    throw FormatError(path, "has " + std::to_string(info.bands()) + " channels",
      "a label image of one channel", "save the labels as gray values, without a palette");
  }
  LabelImage image;
  image.width = info.width;
  image.height = info.height;
  std::vector<double> row(static_cast<std::size_t>(info.width));
  for (int y = 0; y < info.height; ++y)
  {
    file->readBlock({ 0, info.width, y, y + 1 }, {}, row.data());
    for (std::size_t x = 0; x < row.size(); ++x)
    {
      const double value = row[x];
      if (!(value >= 0.0 && value <= std::numeric_limits<std::int32_t>::max() &&
            value == std::floor(value)))
      {
        throw FormatError(path,
          "the pixel in column " + std::to_string(x + 1) + " of row " + std::to_string(y + 1) +
            " is " + numberText(value),
          "whole numbers from 0 up", "name a label image");
      }
      image.labels.push_back(static_cast<std::int32_t>(value));
    }
  }
  return image;
}

} // namespace msi

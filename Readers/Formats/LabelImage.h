// Images whose values are names of regions: 0 for none, 1, 2, ... for the patches of a chart.
#pragma once

#include <cstdint>
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

// Reads an integer image of one channel, unscaled. Errors: FormatError naming the file, for images of
// several channels, fractional or negative values.
LabelImage readLabelImage(const std::string& path);

} // namespace msi

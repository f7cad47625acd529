// A small copy of an image, in which a chart is searched for.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Square root of the values relative to each channel's 99th percentile, which makes noise and contrast alike over dark
// and bright patches; a pixel is a column. Row 0 is the top row.
struct ChartImage
{
  int width = 0;
  int height = 0;
  int reduction = 1;      // pixels of the original along a side of a pixel of this image
  Eigen::MatrixXf values; // channels x (width * height)

  auto at(int x, int y) const { return values.col(static_cast<Eigen::Index>(y) * width + x); }
  // The place in the original of a place in this image; both have the middle of the first pixel at 0.
  Eigen::Vector2d original(const Eigen::Vector2d& place) const
  {
    return ((place.array() + 0.5) * reduction - 0.5).matrix();
  }
};

// pixels: channels x (width * height), row by row from the top. Averages over whole blocks of pixels so that the longer
// side has at most `longest` pixels, then over 3 x 3 of those. A block with a value that is not finite is NaN.
// Errors: std::invalid_argument where the number of pixels does not fit, or no channel has a value above 0.
ChartImage makeChartImage(
  const Eigen::Ref<const Eigen::MatrixXf>& pixels, int width, int height, int longest = 600);

} // namespace msi

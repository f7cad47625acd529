#include "Kernels/Sampling/EvenRegions.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace msi
{

namespace
{
// Largest change over two pixels, relative to white: from the noise of good images to coarse texture.
constexpr std::array<float, 7> Thresholds{ 0.01F, 0.018F, 0.03F, 0.045F, 0.065F, 0.09F, 0.13F };
constexpr std::ptrdiff_t LeastPixels = 16;

// The largest change of any channel over the neighbours of each pixel; infinite at the border and beside NaN.
std::vector<float> activity(const ChartImage& image)
{
  std::vector<float> result(
    static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), INFINITY);
  for (int y = 1; y + 1 < image.height; ++y)
  {
    for (int x = 1; x + 1 < image.width; ++x)
    {
      const auto dx = (image.at(x + 1, y) - image.at(x - 1, y)).cwiseAbs();
      const auto dy = (image.at(x, y + 1) - image.at(x, y - 1)).cwiseAbs();
      const float change = std::max(dx.maxCoeff(), dy.maxCoeff());
      if ((dx + dy).allFinite())
      {
        result[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(x)] = change;
      }
    }
  }
  return result;
}

struct Moments
{
  double count = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  bool atBorder = false;
};

bool isParallelogram(const Moments& moments)
{
  constexpr double Parallelogram = 144.0;
  constexpr double PixelVariance = 1.0 / 12.0; // of a pixel's own extent
  constexpr double Least = 0.9;
  constexpr double Most = 1.05;
  constexpr double Elongation = 16.0; // of the variances
  if (moments.atBorder || moments.count < static_cast<double>(LeastPixels))
  {
    return false;
  }
  const Eigen::Vector2d mean = moments.sum / moments.count;
  Eigen::Matrix2d covariance = moments.squares / moments.count - mean * mean.transpose();
  covariance.diagonal().array() += PixelVariance;
  const double determinant = covariance.determinant();
  const double trace = covariance.trace();
  const double root = std::sqrt(std::max(0.0, trace * trace / 4.0 - determinant));
  const double ratio = moments.count * moments.count / (Parallelogram * determinant);
  return ratio >= Least && ratio <= Most && trace / 2.0 + root <= Elongation * (trace / 2.0 - root);
}

// Flood fill of pixels below the threshold from a seed; marks them with `mark`.
Moments fill(const std::vector<float>& change, float threshold, int width, int height,
  std::size_t seed, int mark, std::vector<int>& marks, std::vector<std::size_t>& stack)
{
  Moments moments;
  const auto columns = static_cast<std::size_t>(width);
  stack.assign(1, seed);
  marks[seed] = mark;
  while (!stack.empty())
  {
    const std::size_t at = stack.back();
    stack.pop_back();
    const auto x = static_cast<int>(at % columns);
    const auto y = static_cast<int>(at / columns);
    const Eigen::Vector2d place(x, y);
    moments.count += 1.0;
    moments.sum += place;
    moments.squares += place * place.transpose();
    moments.atBorder = moments.atBorder || x <= 1 || y <= 1 || x + 2 >= width || y + 2 >= height;
    const auto visit = [&](std::size_t next)
    {
      if (marks[next] != mark && change[next] <= threshold)
      {
        marks[next] = mark;
        stack.push_back(next);
      }
    };
    if (x > 0)
    {
      visit(at - 1);
    }
    if (x + 1 < width)
    {
      visit(at + 1);
    }
    if (y > 0)
    {
      visit(at - columns);
    }
    if (y + 1 < height)
    {
      visit(at + columns);
    }
  }
  return moments;
}

// The larger of two areas at the same place stays.
void keep(std::vector<EvenRegion>& regions, const EvenRegion& region)
{
  constexpr double SamePlace = 0.3; // of the length of a side
  for (auto& other : regions)
  {
    const double side = std::sqrt(std::max(other.area, region.area));
    if ((other.center - region.center).norm() < SamePlace * side)
    {
      if (region.area > other.area)
      {
        other = region;
      }
      return;
    }
  }
  regions.push_back(region);
}
}

std::vector<EvenRegion> findEvenRegions(const ChartImage& image)
{
  const auto change = activity(image);
  std::vector<EvenRegion> regions;
  std::vector<int> marks(change.size(), -1);
  std::vector<std::size_t> stack;
  for (std::size_t t = 0; t < Thresholds.size(); ++t)
  {
    const int mark = static_cast<int>(t);
    for (std::size_t seed = 0; seed < change.size(); ++seed)
    {
      if (marks[seed] == mark || change[seed] > Thresholds[t])
      {
        continue;
      }
      const auto moments =
        fill(change, Thresholds[t], image.width, image.height, seed, mark, marks, stack);
      if (isParallelogram(moments))
      {
        keep(regions, { moments.sum / moments.count, moments.count });
      }
    }
  }
  return regions;
}

} // namespace msi

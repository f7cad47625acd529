#include "Kernels/Sampling/PatchQuality.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace msi
{

namespace
{
double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// |mean of one half - mean of the other| along an axis.
double difference(const std::vector<double>& values, const std::vector<double>& axis)
{
  const double middle = median(axis);
  double sums[2] = { 0.0, 0.0 };
  double counts[2] = { 0.0, 0.0 };
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const int half = axis[i] < middle ? 0 : 1;
    sums[half] += values[i];
    counts[half] += 1.0;
  }
  return counts[0] > 0.0 && counts[1] > 0.0 ? std::abs(sums[0] / counts[0] - sums[1] / counts[1])
                                            : 0.0;
}
}

PatchQuality patchQuality(const Eigen::Ref<const Eigen::MatrixXf>& pixels,
  const Eigen::Ref<const Eigen::Matrix2Xd>& places,
  const Eigen::Ref<const Eigen::VectorXf>& clipping)
{
  constexpr double Robust = 1.4826; // of a normal distribution
  constexpr double Far = 5.0;
  constexpr double Visible = 0.02;
  PatchQuality quality;
  std::vector<double> levels;
  std::vector<double> x;
  std::vector<double> y;
  double clipped = 0.0;
  for (Eigen::Index i = 0; i < pixels.cols(); ++i)
  {
    const auto pixel = pixels.col(i);
    if (!pixel.allFinite())
    {
      clipped += 1.0;
      continue;
    }
    clipped += (pixel.array() >= clipping.array()).any() ? 1.0 : 0.0;
    levels.push_back(static_cast<double>(pixel.mean()));
    x.push_back(places(0, i));
    y.push_back(places(1, i));
  }
  const auto count = static_cast<double>(std::max<Eigen::Index>(1, pixels.cols()));
  quality.clipped = clipped / count;
  if (levels.empty())
  {
    return quality;
  }
  const double middle = median(levels);
  std::vector<double> distances;
  distances.reserve(levels.size());
  double sum = 0.0;
  for (const double level : levels)
  {
    distances.push_back(std::abs(level - middle));
    sum += level;
  }
  const double reach = std::max(Far * Robust * median(distances), Visible * std::abs(middle));
  const auto far = std::count_if(
    distances.begin(), distances.end(), [reach](double distance) { return distance > reach; });
  quality.outliers = static_cast<double>(far) / count;
  const double mean = sum / static_cast<double>(levels.size());
  if (mean > 0.0)
  {
    quality.slope = std::max(difference(levels, x), difference(levels, y)) / mean;
  }
  return quality;
}

} // namespace msi

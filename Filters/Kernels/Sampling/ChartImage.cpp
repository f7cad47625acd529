#include "Kernels/Sampling/ChartImage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace msi
{

namespace
{
// The mean of each block; a NaN makes its block NaN.
Eigen::MatrixXf reduced(
  const Eigen::Ref<const Eigen::MatrixXf>& pixels, int width, int reduction, int columns, int rows)
{
  Eigen::MatrixXf result(pixels.rows(), static_cast<Eigen::Index>(columns) * rows);
  const float share = 1.0F / static_cast<float>(reduction * reduction);
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      Eigen::VectorXf sum = Eigen::VectorXf::Zero(pixels.rows());
      for (int dy = 0; dy < reduction; ++dy)
      {
        const auto first = (static_cast<Eigen::Index>(y) * reduction + dy) * width +
          static_cast<Eigen::Index>(x) * reduction;
        sum += pixels.middleCols(first, reduction).rowwise().sum();
      }
      result.col(static_cast<Eigen::Index>(y) * columns + x) = sum * share;
    }
  }
  return result;
}

Eigen::MatrixXf smoothed(const Eigen::MatrixXf& values, int width, int height)
{
  Eigen::MatrixXf result(values.rows(), values.cols());
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const int left = std::max(0, x - 1);
      const int count = std::min(width - 1, x + 1) - left + 1;
      Eigen::VectorXf sum = Eigen::VectorXf::Zero(values.rows());
      int rows = 0;
      for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j, ++rows)
      {
        sum +=
          values.middleCols(static_cast<Eigen::Index>(j) * width + left, count).rowwise().sum();
      }
      result.col(static_cast<Eigen::Index>(y) * width + x) = sum / static_cast<float>(count * rows);
    }
  }
  return result;
}

float percentile99(const Eigen::Ref<const Eigen::RowVectorXf>& channel)
{
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(channel.size()));
  for (Eigen::Index i = 0; i < channel.size(); ++i)
  {
    if (std::isfinite(channel[i]))
    {
      values.push_back(channel[i]);
    }
  }
  if (values.empty())
  {
    return 0.0F;
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 99 / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}
}

ChartImage makeChartImage(
  const Eigen::Ref<const Eigen::MatrixXf>& pixels, int width, int height, int longest)
{
  if (width < 1 || height < 1 || longest < 1 ||
    pixels.cols() != static_cast<Eigen::Index>(width) * height || pixels.rows() < 1)
  {
    throw std::invalid_argument("an image of " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels was given " + std::to_string(pixels.cols()) +
      " pixels of " + std::to_string(pixels.rows()) + " channels");
  }
  ChartImage image;
  image.reduction = (std::max(width, height) + longest - 1) / longest;
  image.width = std::max(1, width / image.reduction);
  image.height = std::max(1, height / image.reduction);
  image.values = smoothed(
    reduced(pixels, width, image.reduction, image.width, image.height), image.width, image.height);
  bool any = false;
  for (Eigen::Index k = 0; k < image.values.rows(); ++k)
  {
    const float white = percentile99(image.values.row(k));
    if (white > 0.0F)
    {
      any = true;
      // Infinities and NaN stay what they are.
      image.values.row(k) = (image.values.row(k) / white).cwiseMax(0.0F).cwiseSqrt();
    }
    else
    {
      image.values.row(k).setZero();
    }
  }
  if (!any)
  {
    throw std::invalid_argument("the image has no value above 0; there is no chart to be seen");
  }
  return image;
}

} // namespace msi

#include "Kernels/Gap/Field/FieldNeighbourhood.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace msi
{

namespace
{
constexpr double GaussianCut = 4.0;
constexpr double SmallVariance = 0.04; // below, the blur is a second difference
constexpr double VarianceStep = 0.02;

using Taps = AxisKernels::Taps;

// Cubic convolution (ChannelRegistration) for a displacement, and its derivative by it.
std::array<double, 4> interpolation(double t, bool derivative)
{
  if (derivative)
  {
    // by the displacement: minus the derivative by t
    return { 0.5 - 2.0 * t + 1.5 * t * t, 5.0 * t - 4.5 * t * t, -0.5 - 4.0 * t + 4.5 * t * t,
      t - 1.5 * t * t };
  }
  const double t2 = t * t;
  const double t3 = t2 * t;
  return { -0.5 * t + t2 - 0.5 * t3, 1.0 - 2.5 * t2 + 1.5 * t3, 0.5 * t + 2.0 * t2 - 1.5 * t3,
    -0.5 * t2 + 0.5 * t3 };
}

std::vector<double> gaussian(double variance, int reach)
{
  std::vector<double> weight(2 * static_cast<std::size_t>(reach) + 1, 0.0);
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i)
  {
    const double distance = i;
    const bool inside = variance > 0.0 && std::fabs(distance) <= GaussianCut * std::sqrt(variance);
    const double value = i == 0 ? 1.0
      : inside                  ? std::exp(-0.5 * distance * distance / variance)
                                : 0.0;
    const int tap = i + reach;
    weight[static_cast<std::size_t>(tap)] = value;
    sum += value;
  }
  for (double& value : weight)
  {
    value /= sum;
  }
  return weight;
}

// Derivative of the Gaussian's weights by its variance.
std::vector<double> gaussianSlope(double variance, int reach)
{
  if (variance < SmallVariance)
  {
    std::vector<double> weight(2 * static_cast<std::size_t>(reach) + 1, 0.0);
    const auto middle = static_cast<std::size_t>(reach);
    weight[middle - 1] = weight[middle + 1] = 0.5;
    weight[middle] = -1.0;
    return weight;
  }
  std::vector<double> above = gaussian(variance * (1.0 + VarianceStep), reach);
  const std::vector<double> below = gaussian(variance * (1.0 - VarianceStep), reach);
  for (std::size_t i = 0; i < above.size(); ++i)
  {
    above[i] = (above[i] - below[i]) / (2.0 * VarianceStep * variance);
  }
  return above;
}

Taps joined(double displacement, const std::vector<double>& blur, bool derivative)
{
  const double below = std::floor(-displacement);
  const std::array<double, 4> shift = interpolation(-displacement - below, derivative);
  const int reach = static_cast<int>(blur.size() / 2);
  Taps taps;
  taps.first = static_cast<int>(below) - 1 - reach;
  taps.weight.assign(blur.size() + 3, 0.0);
  for (std::size_t i = 0; i < blur.size(); ++i)
  {
    for (std::size_t j = 0; j < 4; ++j)
    {
      taps.weight[i + j] += blur[i] * shift[j];
    }
  }
  return taps;
}

double sum(const Taps& taps, const float* row, std::ptrdiff_t step) noexcept
{
  double result = 0.0;
  for (std::size_t i = 0; i < taps.weight.size(); ++i)
  {
    result += taps.weight[i] * static_cast<double>(row[static_cast<std::ptrdiff_t>(i) * step]);
  }
  return result;
}
}

AxisKernels::AxisKernels(double displacement, double variance)
{
  const int reach = std::max(
    1, static_cast<int>(std::ceil(GaussianCut * std::sqrt(variance * (1.0 + VarianceStep)))));
  const std::vector<double> spread = gaussian(variance, reach);
  value = joined(displacement, spread, false);
  shift = joined(displacement, spread, true);
  blur = joined(displacement, gaussianSlope(variance, reach), false);
}

FieldNeighbourhood::FieldNeighbourhood(const FieldData& data, const ImageWindow& window,
  Eigen::Index channel, const AxisKernels& x, const AxisKernels& y, bool derivatives)
  : value(window.width, window.height)
{
  if (derivatives)
  {
    right.resize(window.width, window.height);
    down.resize(window.width, window.height);
    blur.resize(window.width, window.height);
  }
  const ImageExtent& extent = data.pair.extent;
  const auto K = static_cast<std::size_t>(data.channels());
  const int rows = window.height + static_cast<int>(y.value.weight.size()) - 1;
  const int columns = window.width + static_cast<int>(x.value.weight.size()) - 1;
  std::vector<float> line(static_cast<std::size_t>(columns));
  Eigen::ArrayXXf along(derivatives ? 3 * window.width : window.width, rows);
  for (int row = 0; row < rows; ++row)
  {
    const int v = std::clamp(window.y + y.value.first + row, 0, extent.height - 1);
    for (int i = 0; i < columns; ++i)
    {
      const int u = std::clamp(window.x + x.value.first + i, 0, extent.width - 1);
      line[static_cast<std::size_t>(i)] =
        data.scene[data.pair.index(u, v) * K + static_cast<std::size_t>(channel)];
    }
    for (int i = 0; i < window.width; ++i)
    {
      along(i, row) = static_cast<float>(sum(x.value, line.data() + i, 1));
      if (derivatives)
      {
        along(window.width + i, row) = static_cast<float>(sum(x.shift, line.data() + i, 1));
        along(2 * window.width + i, row) = static_cast<float>(sum(x.blur, line.data() + i, 1));
      }
    }
  }
  const std::ptrdiff_t step = along.rows();
  for (int j = 0; j < window.height; ++j)
  {
    for (int i = 0; i < window.width; ++i)
    {
      const float* first = &along(i, j);
      value(i, j) = sum(y.value, first, step);
      if (derivatives)
      {
        down(i, j) = sum(y.shift, first, step);
        right(i, j) = sum(y.value, first + window.width, step);
        blur(i, j) = sum(y.blur, first, step) +
          sum(y.value, first + 2 * static_cast<std::ptrdiff_t>(window.width), step);
      }
    }
  }
}

} // namespace msi

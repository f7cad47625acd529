#include "Kernels/Gap/Field/FieldBlockLight.h"

#include "Kernels/Gap/Field/FieldColumns.h"
#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace msi
{

FieldDisplacement::FieldDisplacement(
  const FieldPair& pair, const FieldModel& model, Eigen::Index channel)
  : Pair(&pair)
  , Moved{ model.at(ImageParameter::Right, channel), model.at(ImageParameter::Down, channel) }
{
  const double scale = 1.0 / (1.0 + model.at(ImageParameter::Magnification, channel));
  const double angle = Degree * model.at(ImageParameter::Rotation, channel);
  Cosine = scale * std::cos(angle);
  Sine = scale * std::sin(angle);
  Varies = Cosine != 1.0 || Sine != 0.0;
}

FieldDisplacement::Place FieldDisplacement::at(double x, double y) const noexcept
{
  if (!Varies)
  {
    return Moved;
  }
  const double right = Pair->offX(x) - Moved.right;
  const double down = Pair->offY(y) - Moved.down;
  return { Pair->offX(x) - Cosine * right - Sine * down,
    Pair->offY(y) - Cosine * down + Sine * right };
}

FieldDisplacement::Place FieldDisplacement::beyondMiddle(
  const ImageWindow& window, double x, double y) const noexcept
{
  const double right = x - (window.x + 0.5 * (window.width - 1));
  const double down = y - (window.y + 0.5 * (window.height - 1));
  return { right - Cosine * right - Sine * down, down - Cosine * down + Sine * right };
}

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

namespace
{
FieldNeighbourhood near(const FieldData& data, const FieldModel& model, const ImageWindow& window,
  Eigen::Index channel, const FieldDisplacement& where, bool derivatives)
{
  const double variance = std::max(model.at(ImageParameter::BlurVariance, channel), 0.0);
  const FieldDisplacement::Place middle = where.atMiddle(window);
  return { data, window, channel, AxisKernels(middle.right, variance),
    AxisKernels(middle.down, variance), derivatives || where.varies() };
}
}

BlockLight::BlockLight(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, bool derivatives)
  : Block(block)
  , K(static_cast<std::size_t>(data.channels()))
  , Channel(static_cast<std::size_t>(channel))
  , Where(data.pair, model, channel)
  , Near(near(data, model, block.window, channel, Where, derivatives))
  , Weights(tailWeights(model, channel))
  , Added((model.at(ImageParameter::Glare, channel) +
            model.at(ImageParameter::ConservingGlare, channel)) *
      glare[channel])
  , Lost(1.0 - model.at(ImageParameter::ConservingGlare, channel))
{
  for (std::size_t number = 0; number < imageLights().size(); ++number)
  {
    Strength.push_back(model.at(imageLight(number), channel));
    for (int i = 0; i < static_cast<int>(block.window.pixels()); ++i)
    {
      const ImagePlace pixel{ block.window.x + i % block.window.width,
        block.window.y + i / block.window.width };
      Others.push_back(
        lightElsewhere(data.pair, data.scene, model, imageLights()[number], pixel, Channel));
    }
  }
}

std::vector<double> fieldFactors(
  const FieldData& data, const FieldModel& model, const ImageWindow& window)
{
  std::vector<double> factors;
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      factors.push_back(model.fieldFactor(data.pair.fieldX(x), data.pair.fieldY(y)));
    }
  }
  return factors;
}

} // namespace msi

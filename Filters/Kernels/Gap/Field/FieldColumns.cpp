#include "Kernels/Gap/Field/FieldColumns.h"

#include "Kernels/Camera/Imaging/ScatterTail.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace msi
{

namespace
{
constexpr double TwoPi = 6.283185307179586;
constexpr double GaussianCut = 4.0;
constexpr double SmallVariance = 0.04; // below, the blur is a second difference
constexpr double VarianceStep = 0.02;

// A kernel with weights from `first` on.
struct Taps
{
  int first = 0;
  std::vector<double> weight;
};

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

struct AxisKernels
{
  Taps value, shift, blur;

  AxisKernels(double displacement, double variance)
  {
    const int reach = std::max(
      1, static_cast<int>(std::ceil(GaussianCut * std::sqrt(variance * (1.0 + VarianceStep)))));
    const std::vector<double> spread = gaussian(variance, reach);
    value = joined(displacement, spread, false);
    shift = joined(displacement, spread, true);
    blur = joined(displacement, gaussianSlope(variance, reach), false);
  }
};

double sum(const Taps& taps, const float* row, std::ptrdiff_t step) noexcept
{
  double result = 0.0;
  for (std::size_t i = 0; i < taps.weight.size(); ++i)
  {
    result += taps.weight[i] * static_cast<double>(row[static_cast<std::ptrdiff_t>(i) * step]);
  }
  return result;
}

// The moved and blurred scene of a block and its derivatives.
struct Neighbourhood
{
  Eigen::ArrayXXd value, right, down, blur; // width x height

  Neighbourhood(const FieldData& data, const ImageWindow& window, Eigen::Index channel,
    const AxisKernels& x, const AxisKernels& y)
    : value(window.width, window.height)
    , right(window.width, window.height)
    , down(window.width, window.height)
    , blur(window.width, window.height)
  {
    const ImageExtent& extent = data.pair.extent;
    const auto K = static_cast<std::size_t>(data.channels());
    const auto reach = static_cast<int>(y.value.weight.size());
    const int rows = window.height + reach - 1;
    const int columns = window.width + static_cast<int>(x.value.weight.size()) - 1;
    std::vector<float> line(static_cast<std::size_t>(columns));
    Eigen::ArrayXXf along(3 * window.width, rows);
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
        along(window.width + i, row) = static_cast<float>(sum(x.shift, line.data() + i, 1));
        along(2 * window.width + i, row) = static_cast<float>(sum(x.blur, line.data() + i, 1));
      }
    }
    const std::ptrdiff_t step = along.rows();
    for (int j = 0; j < window.height; ++j)
    {
      for (int i = 0; i < window.width; ++i)
      {
        const float* first = &along(i, j);
        value(i, j) = sum(y.value, first, step);
        down(i, j) = sum(y.shift, first, step);
        right(i, j) = sum(y.value, first + window.width, step);
        blur(i, j) = sum(y.blur, first, step) +
          sum(y.value, first + 2 * static_cast<std::ptrdiff_t>(window.width), step);
      }
    }
  }
};
}

Eigen::ArrayXd tailWeights(double radius)
{
  const ScatterTail tail(std::clamp(radius, 1.0, 64.0));
  Eigen::ArrayXd weights = Eigen::ArrayXd::Zero(TailPasses);
  Eigen::Index pass = 0;
  for (const float weight : tail.weights())
  {
    weights[std::min<Eigen::Index>(pass++, TailPasses - 1)] += static_cast<double>(weight);
  }
  return weights;
}

Eigen::ArrayXd tailSlope(double radius)
{
  const double step = 0.02 * radius;
  const double above = std::min(radius + step, 64.0);
  const double below = std::max(radius - step, 1.0);
  return (tailWeights(above) - tailWeights(below)) / (above - below);
}

void fieldColumns(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, FieldScratch& scratch)
{
  using P = FieldParameter;
  const ImageWindow& window = block.window;
  const auto K = static_cast<std::size_t>(data.channels());
  const auto k = static_cast<std::size_t>(channel);
  const double offX = window.x + 0.5 * (window.width - 1) - 0.5 * (data.pair.extent.width - 1);
  const double offY = window.y + 0.5 * (window.height - 1) - 0.5 * (data.pair.extent.height - 1);
  const double magnification = model.at(P::Magnification, channel);
  const double variance = std::max(model.at(P::BlurVariance, channel), 0.0);
  // Out of the source at middle + (position - middle - displacement) / (1 + magnification).
  const AxisKernels alongX(
    (model.at(P::Right, channel) + magnification * offX) / (1.0 + magnification), variance);
  const AxisKernels alongY(
    (model.at(P::Down, channel) + magnification * offY) / (1.0 + magnification), variance);
  const Neighbourhood near(data, window, channel, alongX, alongY);
  const Eigen::ArrayXd weights = tailWeights(model.at(P::TailRadius, channel));
  const double fraction = model.at(P::TailFraction, channel);
  const double added = model.at(P::Glare, channel) + model.at(P::ConservingGlare, channel);
  const double lost = 1.0 - model.at(P::ConservingGlare, channel);
  const double gain = model.at(P::Gain, channel);
  const double square = model.at(P::Square, channel);
  const double dark = model.at(P::Dark, channel);

  scratch.pixel.clear();
  for (std::size_t i = 0; i < window.pixels(); ++i)
  {
    if (std::isfinite(block.real[i * K + k]))
    {
      scratch.pixel.push_back(static_cast<int>(i));
    }
  }
  const auto count = static_cast<Eigen::Index>(scratch.pixel.size());
  scratch.columns.setZero(count, FieldColumn::Count);
  scratch.level.resize(count);
  Eigen::Array<double, TailPasses, 1> surround;
  for (Eigen::Index n = 0; n < count; ++n)
  {
    const int i = scratch.pixel[static_cast<std::size_t>(n)];
    const int column = i % window.width;
    const int row = i / window.width;
    const double x = data.pair.fieldX(window.x + column);
    const double y = data.pair.fieldY(window.y + row);
    const double self = near.value(column, row);
    for (int pass = 0; pass < TailPasses; ++pass)
    {
      surround[pass] = static_cast<double>(
        block
          .tail[(static_cast<std::size_t>(pass) * window.pixels() + static_cast<std::size_t>(i)) *
              K +
            k]);
    }
    const double field = model.fieldFactor(x, y);
    const double light = field * (self + fraction * ((weights * surround).sum() - self));
    const double chain = gain * model.bandFactor(channel, window.x + column, window.y + row);
    const double linear = chain * (lost * light + added * glare[channel]);
    const double slope = 1.0 + 2.0 * square * linear;
    const double predicted = linear * (1.0 + square * linear) + dark;
    const double local = slope * chain * lost * field;
    const double u = slope * linear;
    const double direct = slope * chain * lost * light; // what the field's factors act on
    auto out = scratch.columns.row(n);
    out[FieldColumn::Gain] = u;
    out[FieldColumn::One] = 1.0;
    out[FieldColumn::GradientRight] = x * direct;
    out[FieldColumn::GradientDown] = y * direct;
    out[FieldColumn::RadiusSquared] = (x * x + y * y) * direct;
    out[FieldColumn::Square] = linear * linear;
    const double right = local * (1.0 - fraction) * near.right(column, row);
    const double down = local * (1.0 - fraction) * near.down(column, row);
    out[FieldColumn::Right] = right;
    out[FieldColumn::Down] = down;
    out[FieldColumn::Magnification] = (offX + column - 0.5 * (window.width - 1)) * right +
      (offY + row - 0.5 * (window.height - 1)) * down;
    out[FieldColumn::BlurVariance] = local * (1.0 - fraction) * near.blur(column, row);
    for (int pass = 0; pass < TailPasses; ++pass)
    {
      out[FieldColumn::Tail + pass] = local * (surround[pass] - self);
    }
    if (model.rowPeriod > 0.0)
    {
      const double angle = TwoPi * (window.y + row) / model.rowPeriod;
      out[FieldColumn::RowSine] = std::sin(angle) * u;
      out[FieldColumn::RowCosine] = std::cos(angle) * u;
    }
    if (model.columnPeriod > 0.0)
    {
      const double angle = TwoPi * (window.x + column) / model.columnPeriod;
      out[FieldColumn::ColumnSine] = std::sin(angle) * u;
      out[FieldColumn::ColumnCosine] = std::cos(angle) * u;
    }
    out[FieldColumn::Diagonal] = x * y * direct;
    out[FieldColumn::Saddle] = (x * x - y * y) * direct;
    out[FieldColumn::Residual] =
      static_cast<double>(block.real[static_cast<std::size_t>(i) * K + k]) - predicted;
    scratch.level[n] = predicted;
  }
}

} // namespace msi

#include "Kernels/Gap/Field/FieldBlockLight.h"

#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace msi
{

FieldDisplacement::FieldDisplacement(
  const FieldPair& pair, const FieldModel& model, Eigen::Index channel)
  : Pair(&pair)
{
  const ImageDisplacement displacement = model.displacement(channel);
  Moved = { displacement.right, displacement.down };
  const double scale = 1.0 / (1.0 + displacement.magnification);
  const double angle = Degree * displacement.rotation;
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

// result += sum over i of weight_i times the numbers from i on
template <typename Result, typename Numbers>
void addTaps(const Taps& taps, Result&& result, const Numbers& from)
{
  for (std::size_t i = 0; i < taps.weight.size(); ++i)
  {
    result += taps.weight[i] * from(static_cast<Eigen::Index>(i));
  }
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
  Eigen::Index channel, const AxisKernels& x, const AxisKernels& y)
  : value(Eigen::ArrayXXd::Zero(window.width, window.height))
  , right(value)
  , down(value)
  , blur(value)
{
  const ImageExtent& extent = data.pair.extent;
  const auto K = static_cast<std::size_t>(data.channels());
  const Eigen::Index width = window.width;
  const Eigen::Index rows = window.height + static_cast<Eigen::Index>(y.value.weight.size()) - 1;
  Eigen::ArrayXd line(width + static_cast<Eigen::Index>(x.value.weight.size()) - 1);
  // Along the rows: the value, its derivatives by displacement and by blur.
  const Taps* kernels[] = { &x.value, &x.shift, &x.blur };
  std::array<Eigen::ArrayXXd, 3> along;
  along.fill(Eigen::ArrayXXd::Zero(width, rows));
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    const int v =
      std::clamp(window.y + y.value.first + static_cast<int>(row), 0, extent.height - 1);
    for (Eigen::Index i = 0; i < line.size(); ++i)
    {
      const int u = std::clamp(window.x + x.value.first + static_cast<int>(i), 0, extent.width - 1);
      line[i] = static_cast<double>(
        data.scene[data.pair.index(u, v) * K + static_cast<std::size_t>(channel)]);
    }
    for (std::size_t n = 0; n < along.size(); ++n)
    {
      addTaps(
        *kernels[n], along[n].col(row), [&](Eigen::Index i) { return line.segment(i, width); });
    }
  }
  for (Eigen::Index j = 0; j < window.height; ++j)
  {
    const auto across = [&](std::size_t n)
    { return [&, n](Eigen::Index i) { return along[n].col(j + i); }; };
    addTaps(y.value, value.col(j), across(0));
    addTaps(y.shift, down.col(j), across(0));
    addTaps(y.value, right.col(j), across(1));
    addTaps(y.blur, blur.col(j), across(0));
    addTaps(y.value, blur.col(j), across(2));
  }
}

namespace
{
FieldNeighbourhood neighbourhood(const FieldData& data, const FieldModel& model,
  const ImageWindow& window, Eigen::Index channel, const FieldDisplacement& where)
{
  const double variance = model.blurVariance(channel);
  const FieldDisplacement::Place middle = where.atMiddle(window);
  return { data, window, channel, AxisKernels(middle.right, variance),
    AxisKernels(middle.down, variance) };
}
}

BlockLight::BlockLight(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, const AskedSteps& asked)
  : Data(data)
  , Block(block)
  , Steps(model.steps(ImageStage::Scene, ImageStage::Light, channel, asked))
  , Active(model.steps(ImageStage::Scene, ImageStage::Light, channel))
  , Glare(glare[channel])
  , Where(data.pair, model, channel)
  , Near(neighbourhood(data, model, block.window, channel, Where))
  , Weights(model.tailWeights(channel))
{
  const std::size_t pixels = block.window.pixels();
  const FieldFactor factor(model);
  Surround.reserve(pixels * TailPasses);
  const auto K = static_cast<std::size_t>(data.channels());
  const auto k = static_cast<std::size_t>(channel);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    for (std::size_t pass = 0; pass < TailPasses; ++pass)
    {
      Surround.push_back(static_cast<double>(block.tail[(pass * pixels + i) * K + k]));
    }
    const int x = static_cast<int>(i) % block.window.width;
    const int y = static_cast<int>(i) / block.window.width;
    addElsewhere(
      data.pair, data.scene, factor, { block.window.x + x, block.window.y + y }, k, Others);
  }
}

ImagePixel BlockLight::pixel(int number) const
{
  const int x = Block.window.x + number % Block.window.width;
  const int y = Block.window.y + number / Block.window.width;
  ImagePixel pixel;
  pixel.x = Data.pair.fieldX(x);
  pixel.y = Data.pair.fieldY(y);
  pixel.fromMiddleX = Data.pair.offX(x);
  pixel.fromMiddleY = Data.pair.offY(y);
  pixel.right = Near.right(number);
  pixel.down = Near.down(number);
  pixel.blur = Near.blur(number);
  pixel.surround = Surround.data() + std::size_t{ TailPasses } * static_cast<std::size_t>(number);
  pixel.tailWeights = Weights.data();
  pixel.mean = Glare;
  return pixel;
}

double BlockLight::near(int number, const ImagePixel& pixel) const
{
  double value = Near.value(number);
  if (Where.varies())
  {
    const int row = number / Block.window.width;
    const FieldDisplacement::Place more = Where.beyondMiddle(
      Block.window, Block.window.x + number % Block.window.width, Block.window.y + row);
    value += more.right * pixel.right + more.down * pixel.down;
  }
  return value;
}

const double* BlockLight::others(int number) const
{
  return Others.data() + Others.size() / Block.window.pixels() * static_cast<std::size_t>(number);
}

double BlockLight::signal(int number) const
{
  ImagePixel told = pixel(number);
  return run(Active, told, others(number), near(number, told));
}

double BlockLight::signal(int number, ImagePixel& pixel, StepDerivatives& derivatives) const
{
  return run(Steps, pixel, others(number), near(number, pixel), &derivatives);
}

void addElsewhere(const FieldPair& pair, const float* scene, const FieldFactor& factor,
  const ImagePlace& pixel, std::size_t channel, std::vector<double>& others)
{
  for (const PlacedStep& step : imageSteps())
  {
    if (step.from != nullptr)
    {
      const ImagePlace place = step.from(pixel, pair.extent);
      others.push_back(factor(pair.fieldX(place.x), pair.fieldY(place.y)) *
        static_cast<double>(scene[pair.index(place.x, place.y) * pair.channels.size() + channel]));
    }
  }
}

} // namespace msi

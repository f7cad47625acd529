#include "Kernels/Gap/Field/FieldColumns.h"

#include "Kernels/Camera/Imaging/ChannelRegistration.h"
#include "Kernels/Camera/Imaging/SeparableFilter.h"
#include "Kernels/Numerics/Angle.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace msi
{

const FieldColumns& fieldColumns()
{
  static const FieldColumns known = []
  {
    FieldColumns columns;
    for (const PlacedStep& step : imageSteps())
    {
      for (const ImageNumber& number : step.step->numbers)
      {
        columns.axes.push_back(number.axes);
      }
      columns.axes.insert(columns.axes.end(), step.step->further.begin(), step.step->further.end());
      columns.step.resize(columns.axes.size(), &step);
      columns.blur =
        step.step->blurVariance != nullptr ? static_cast<int>(step.column) : columns.blur;
    }
    const auto with = [&axes = columns.axes](unsigned wanted)
    { return static_cast<int>(std::find(axes.begin(), axes.end(), wanted) - axes.begin()); };
    columns.gain = with(ImageAxis::Channel | ImageAxis::Level);
    columns.offset = with(ImageAxis::Channel);
    columns.residual = static_cast<int>(columns.axes.size());
    columns.count = columns.residual + 1;
    return columns;
  }();
  return known;
}

std::vector<int> FieldColumns::of(unsigned axis) const
{
  std::vector<int> columns;
  for (int c = 0; c < residual; ++c)
  {
    if ((axes[c] & axis) != 0)
    {
      columns.push_back(c);
    }
  }
  return columns;
}

Eigen::VectorXd columnsChanged(
  ImageParameter parameter, const FieldModel& model, const FieldModel& about, Eigen::Index channel)
{
  const PlacedStep& step = stepOf(parameter);
  const auto n = static_cast<int>(parameter - step.number);
  Eigen::VectorXd column = Eigen::VectorXd::Zero(fieldColumns().residual);
  double* own = column.data() + step.column;
  if (step.step->change != nullptr)
  {
    step.step->change(n, model.numbers(step, channel), about.numbers(step, channel), own);
  }
  else
  {
    own[n] = 1.0;
  }
  return column;
}

namespace
{
constexpr double NoiseStep = 1e-3;     // white
constexpr double SmallVariance = 0.04; // below, the blur is a second difference
constexpr double VarianceStep = 0.02;

// Weights of the pixels from -reach to reach.
Eigen::ArrayXd gaussian(double variance, Eigen::Index reach)
{
  const auto end = static_cast<double>(reach);
  const Eigen::ArrayXd square = Eigen::ArrayXd::LinSpaced(2 * reach + 1, -end, end).square();
  const Eigen::ArrayXd weight = (square <= GaussianCut * GaussianCut * variance)
                                  .select((-0.5 * square / std::fmax(variance, 1e-300)).exp(), 0.0);
  return weight / weight.sum();
}

// Their derivatives by the variance.
Eigen::ArrayXd gaussianSlope(double variance, Eigen::Index reach)
{
  if (variance < SmallVariance)
  {
    Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(2 * reach + 1);
    weight.segment<3>(reach - 1) << 0.5, -1.0, 0.5;
    return weight;
  }
  return (gaussian(variance * (1.0 + VarianceStep), reach) -
           gaussian(variance * (1.0 - VarianceStep), reach)) /
    (2.0 * VarianceStep * variance);
}

Eigen::ArrayXd convolved(const Eigen::ArrayXd& blur, const SixPoints<double>& shift)
{
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(blur.size() + shift.size() - 1);
  for (Eigen::Index i = 0; i < shift.size(); ++i)
  {
    weight.segment(i, blur.size()) += shift[i] * blur;
  }
  return weight;
}

// Interpolation for a displacement with a Gaussian of a variance, along one axis: the weights of the
// pixels from `first` on, and their derivatives by displacement and variance.
struct AxisKernel
{
  int first;
  Eigen::ArrayXd value, shift, blur;

  AxisKernel(double displacement, double variance)
  {
    const double below = std::floor(-displacement);
    const double t = -displacement - below;
    const SixPoints<double> shifted = sixPointConvolution(t);
    const SixPoints<double> slope = -sixPointConvolutionSlope(t);
    const int reach = std::max(
      1, static_cast<int>(std::ceil(GaussianCut * std::sqrt(variance * (1.0 + VarianceStep)))));
    const Eigen::ArrayXd spread = gaussian(variance, reach);
    first = static_cast<int>(below) - 2 - reach;
    value = convolved(spread, shifted);
    shift = convolved(spread, slope);
    blur = convolved(gaussianSlope(variance, reach), shifted);
  }
};

// Times a column of numbers: the weighted sums of those from each of the first `count` on.
Eigen::MatrixXd band(const Eigen::ArrayXd& weight, Eigen::Index count)
{
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count + weight.size() - 1);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    matrix.row(i).segment(i, weight.size()) = weight.transpose();
  }
  return matrix;
}

// Covariance of value and derivatives to the right, down and by blur where the scene is white noise of variance 1.
Eigen::Matrix4d covarianceOfNoise(const AxisKernel& x, const AxisKernel& y)
{
  const auto products = [](const AxisKernel& axis)
  {
    Eigen::MatrixX3d weights(axis.value.size(), 3);
    weights << axis.value, axis.shift, axis.blur;
    return Eigen::Matrix3d(weights.transpose() * weights);
  };
  // The last two together are the derivative by blur.
  const std::array<int, 5> ofX{ 0, 1, 0, 2, 0 };
  const std::array<int, 5> ofY{ 0, 0, 1, 0, 2 };
  const Eigen::Matrix<double, 5, 5> all = products(x)(ofX, ofX).cwiseProduct(products(y)(ofY, ofY));
  Eigen::Matrix<double, 4, 5> sum = Eigen::Matrix<double, 4, 5>::Identity();
  sum(3, 4) = 1.0;
  return sum * all * sum.transpose();
}

// The scene in a block, moved and blurred, and, where they are asked for (0 otherwise), its derivatives by displacement and blur:
// width x height, by pixel number, too.
struct Neighbourhood
{
  AxisKernel x, y;
  Eigen::MatrixXd value, right, down, blur;

  Neighbourhood(const FieldData& data, const ImageWindow& window, Eigen::Index channel,
    const Eigen::Vector2d& displacement, double variance, bool derivatives)
    : x(displacement.x(), variance)
    , y(displacement.y(), variance)
  {
    const ImageExtent& extent = data.pair.extent;
    const std::size_t K = data.channels();
    Eigen::MatrixXd scene(window.width + x.value.size() - 1, window.height + y.value.size() - 1);
    for (Eigen::Index j = 0; j < scene.cols(); ++j)
    {
      const int v = std::clamp(window.y + y.first + static_cast<int>(j), 0, extent.height - 1);
      for (Eigen::Index i = 0; i < scene.rows(); ++i)
      {
        const int u = std::clamp(window.x + x.first + static_cast<int>(i), 0, extent.width - 1);
        scene(i, j) = static_cast<double>(data.scene()[data.pair.index(u, v) * K + channel]);
      }
    }
    const Eigen::MatrixXd along = band(x.value, window.width) * scene;
    const Eigen::MatrixXd across = band(y.value, window.height).transpose();
    value = along * across;
    if (!derivatives)
    {
      right = down = blur = Eigen::MatrixXd::Zero(window.width, window.height);
      return;
    }
    right = band(x.shift, window.width) * scene * across;
    down = along * band(y.shift, window.height).transpose();
    blur =
      along * band(y.blur, window.height).transpose() + band(x.blur, window.width) * scene * across;
  }
};

// By how much the scene is moved at a place, and how that changes with the place.
struct Displacement
{
  Eigen::Vector2d moved;
  Eigen::Matrix2d bend;

  Displacement(const ShownPlace& shown, const Eigen::Vector2d& place)
    : moved(place - shown(place))
  {
    for (const Eigen::Index axis : { 0, 1 })
    {
      const Eigen::Vector2d step = Eigen::Vector2d::Unit(axis);
      bend.col(axis) = step - 0.5 * (shown(place + step) - shown(place - step));
    }
  }
};

// What happens to the scene before the detector, in one block and channel. Holds references.
class BlockLight
{
public:
  BlockLight(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
    const FieldBlock& block, Eigen::Index channel, const AskedSteps& asked)
    : Data(data)
    , Block(block)
    , Channel(channel)
    , Steps(model.steps(ImageStage::Scene, ImageStage::Light, channel, asked))
    , Glare(glare[channel])
    , Place(channelPlace(channel, data.channels()))
    , Middle(middleOf(data.pair, block.window))
    , Change(model.ofScene(channel))
    , Where(ShownPlace(Change.displacement, data.pair.extent), Middle)
    , Near(data, block.window, channel, Where.moved, Change.blurVariance,
        std::any_of(Steps.begin(), Steps.end(),
          [](const ChannelStep& step) { return step.placed->step->stage == ImageStage::Scene; }))
  {
    const auto pixels = static_cast<int>(block.window.pixels());
    const FieldFactor factor(model);
    const bool needed = std::any_of(Steps.begin(), Steps.end(),
      [](const ChannelStep& step) { return step.placed->from != nullptr; });
    for (int i = 0; needed && i < pixels; ++i)
    {
      addElsewhere(data.pair, data.scene(), factor, Block.place(i), Channel, Others);
    }
    const ChannelSteps active = model.steps(ImageStage::Scene, ImageStage::Light, channel);
    for (int i = 0; i < pixels; ++i)
    {
      ImagePixel told = pixel(i);
      Signal.push_back(run(active, told, others(i), scene(i, told)));
    }
  }

  // What the steps are told, but for other channels and lines.
  ImagePixel pixel(int number) const
  {
    const ImagePlace place = Block.place(number);
    ImagePixel pixel;
    pixel.x = Data.pair.fieldX(place.x);
    pixel.y = Data.pair.fieldY(place.y);
    pixel.fromMiddleX = Data.pair.offX(place.x);
    pixel.fromMiddleY = Data.pair.offY(place.y);
    pixel.right = Near.right(number);
    pixel.down = Near.down(number);
    pixel.blur = Near.blur(number);
    pixel.surround =
      Block.tail.data() + (number * Data.pair.channels.size() + Channel) * TailPasses;
    pixel.tailWeights = Change.tailWeights.data();
    pixel.mean = Glare;
    pixel.channel = Place;
    return pixel;
  }
  const ChannelSteps& steps() const noexcept { return Steps; }
  // The light on the detector; with its derivatives also by the steps that are asked for.
  const double& signal(int number) const { return Signal[number]; }
  // more: added to the scene.
  double signal(int number, ImagePixel& pixel, StepDerivatives& derivatives, double more) const
  {
    return run(Steps, pixel, others(number), scene(number, pixel) + more, &derivatives);
  }
  Eigen::Matrix4d covarianceOfNoise() const { return msi::covarianceOfNoise(Near.x, Near.y); }

private:
  // Moved as in the middle of the block, and to first order by what is different at this pixel.
  double scene(int number, const ImagePixel& pixel) const
  {
    const Eigen::Vector2d further =
      Where.bend * (Eigen::Vector2d(pixel.fromMiddleX, pixel.fromMiddleY) - Middle);
    return Near.value(number) + further.dot(Eigen::Vector2d(pixel.right, pixel.down));
  }
  const double* others(int number) const
  {
    return Others.data() + Others.size() / Block.window.pixels() * number;
  }

  const FieldData& Data;
  const FieldBlock& Block;
  std::size_t Channel;
  ChannelSteps Steps;
  double Glare, Place; // of the channel
  Eigen::Vector2d Middle;
  SceneChange Change;
  Displacement Where;
  Neighbourhood Near;
  std::vector<double> Others; // light from elsewhere, of each pixel
  std::vector<double> Signal;
};
}

void forColumns(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, const AskedSteps& asked,
  const std::function<void(Eigen::Index, ChannelColumns&)>& act)
{
  const ImageWindow& window = block.window;
  const Eigen::Index K = data.channels();
  std::vector<BlockLight> lights; // of each channel
  lights.reserve(K);
  for (Eigen::Index channel = 0; channel < K; ++channel)
  {
    lights.emplace_back(data, model, glare, block, channel, asked);
  }
  std::vector<double> ofAll(window.pixels(), 0.0); // mean of the lights
  for (std::size_t i = 0; i < ofAll.size(); ++i)
  {
    for (const BlockLight& light : lights)
    {
      ofAll[i] += light.signal(static_cast<int>(i)) / static_cast<double>(K);
    }
  }
  ChannelColumns found;
  StepDerivatives by;
  for (Eigen::Index channel = 0; channel < K; ++channel)
  {
    const BlockLight& light = lights[channel];
    const float* real = block.real.data() + channel;
    found.pixel.clear();
    for (std::size_t i = 0; i < window.pixels(); ++i)
    {
      if (std::isfinite(real[i * K]))
      {
        found.pixel.push_back(static_cast<int>(i));
      }
    }
    const FieldLines rows(model, true, channel, block.fold, window.y, window.height);
    const FieldLines columns(model, false, channel, block.fold, window.x, window.width);
    const Eigen::Index count = found.pixel.size();
    const ChannelSteps behind =
      model.steps(ImageStage::Exposure, ImageStage::Detector, channel, asked);
    ChannelSteps steps = light.steps();
    steps.insert(steps.end(), behind.begin(), behind.end());
    found.there.clear();
    for (const ChannelStep& step : steps)
    {
      for (std::size_t c = 0; c < step.placed->step->width(); ++c)
      {
        found.there.push_back(step.placed->column + c);
      }
    }
    found.there.push_back(fieldColumns().residual);
    found.columns.resize(count, found.there.size());
    found.level.resize(count);
    by = StepDerivatives();
    by.values.push_back(0.0); // the residual
    double answer = 0.0;
    // The columns of a pixel; where the scene and its derivatives to the right, down and by blur are larger by `more`.
    const auto columnsAt = [&](int i, const Eigen::Vector4d& more, auto&& row)
    {
      ImagePixel pixel = light.pixel(i);
      pixel.right += more[1];
      pixel.down += more[2];
      pixel.blur += more[3];
      pixel.previous = channel > 0 ? &lights[channel - 1].signal(i) : nullptr;
      pixel.next = channel + 1 < K ? &lights[channel + 1].signal(i) : nullptr;
      pixel.ofAll = ofAll[i];
      pixel.row = rows[i / window.width];
      pixel.column = columns[i % window.width];
      pixel.self = light.signal(i, pixel, by, more[0]);
      answer = run(behind, pixel, nullptr, pixel.self, &by);
      by.chain(steps);
      by.values.back() = static_cast<double>(real[i * K]) - answer;
      for (std::size_t c = 0; c < found.there.size(); ++c)
      {
        row[c] = by.values[found.there[c]];
      }
    };
    for (Eigen::Index n = 0; n < count; ++n)
    {
      columnsAt(found.pixel[n], Eigen::Vector4d::Zero(), found.columns.row(n));
      found.level[n] = answer;
    }
    found.ofNoise = [&](Eigen::Index column) -> Eigen::VectorXd
    {
      Eigen::MatrixX4d slopes = Eigen::MatrixX4d::Zero(found.columns.cols(), 4);
      if (count > 0)
      {
        const int middle = found.pixel[found.pixel.size() / 2];
        Eigen::VectorXd usual(slopes.rows());
        columnsAt(middle, Eigen::Vector4d::Zero(), usual);
        for (Eigen::Index n = 0; n < 4; ++n)
        {
          columnsAt(middle, NoiseStep * Eigen::Vector4d::Unit(n), slopes.col(n));
        }
        slopes = (slopes.colwise() - usual) / NoiseStep;
      }
      const Eigen::Vector4d ofColumn = light.covarianceOfNoise() * slopes.row(column).transpose();
      return slopes * ofColumn;
    };
    act(channel, found);
  }
}

std::vector<FieldResidual> fieldResiduals(
  const FieldData& data, const FieldModel& model, bool testToo)
{
  const AskedSteps asked{ fieldColumns().step[fieldColumns().gain] };
  const Eigen::Index K = data.channels();
  const Eigen::ArrayXd glare = data.cells.mean(model);
  std::vector<FieldResidual> residuals(data.blocks.size() * K);
  data.forBlocks(
    [&](int b)
    {
      const FieldBlock& block = data.blocks[b];
      if (block.fold < 0 && !testToo)
      {
        return;
      }
      forColumns(data, model, glare, block, asked,
        [&](Eigen::Index k, const ChannelColumns& found)
        {
          const auto gain = std::find(found.there.begin(), found.there.end(), fieldColumns().gain) -
            found.there.begin();
          residuals[b * K + k] = { found.pixel, found.level, found.columns.col(gain),
            found.residual() };
        });
    });
  return residuals;
}

} // namespace msi

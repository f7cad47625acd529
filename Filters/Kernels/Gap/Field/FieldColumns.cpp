#include "Kernels/Gap/Field/FieldColumns.h"

#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Gap/Field/FieldBlockLight.h"
#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace msi
{

namespace
{
constexpr double LeastFactor = 0.05; // of the field, where its derivatives are asked for

// Derivatives of FieldModel::gradient.
struct GradientSlope
{
  double right, down, bend;
};

GradientSlope gradientSlope(const FieldModel& model, double x, double y)
{
  const double right = model.at(ImageParameter::GradientRight, 0);
  const double down = model.at(ImageParameter::GradientDown, 0);
  const double size = std::hypot(right, down);
  if (!(size > 0.0))
  {
    return { x, y, 0.0 };
  }
  const double along = (right * x + down * y) / size;
  const double turn = 2.0 * model.at(ImageParameter::GradientBend, 0) * along / size;
  return { x + turn * (x - right * along / size), y + turn * (y - down * along / size),
    along * along };
}

// The signal of a channel in every pixel of a block; 0 of one that is not there.
std::vector<double> signalOf(const FieldData& data, const FieldModel& model,
  const Eigen::ArrayXd& glare, const FieldBlock& block, Eigen::Index channel,
  const std::vector<double>& factors)
{
  std::vector<double> signal(block.window.pixels(), 0.0);
  if (channel >= 0 && channel < data.channels())
  {
    const BlockLight light(data, model, glare, block, channel, false);
    for (std::size_t i = 0; i < signal.size(); ++i)
    {
      signal[i] = light.signal(static_cast<int>(i), factors[i]);
    }
  }
  return signal;
}

// The channels before and behind; that before is known where it was the last one.
void findNeighbours(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, const std::vector<double>& factors,
  FieldScratch& scratch)
{
  const bool known = scratch.lastBlock == &block && scratch.lastChannel == channel - 1;
  scratch.before =
    known ? scratch.signal : signalOf(data, model, glare, block, channel - 1, factors);
  scratch.next = signalOf(data, model, glare, block, channel + 1, factors);
}
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

Eigen::ArrayXd tailWeights(const FieldModel& model, Eigen::Index channel)
{
  Eigen::ArrayXd weights = model.at(ImageParameter::TailFraction, channel) *
    tailWeights(model.at(ImageParameter::TailRadius, channel));
  for (int i = 0; i < FreePasses; ++i)
  {
    weights[i + 1] += model.at(surroundWeight(i), channel);
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

Eigen::VectorXd columnsChanged(
  ImageParameter parameter, const FieldModel& model, Eigen::Index channel, const FieldShape& shape)
{
  using P = ImageParameter;
  Eigen::VectorXd column = Eigen::VectorXd::Zero(FieldColumn::residual());
  const auto by = [&column](P other) -> double& { return column[FieldColumn::of(other)]; };
  const auto surround = [&column](const Eigen::ArrayXd& weights)
  {
    for (int pass = 0; pass < TailPasses; ++pass)
    {
      column[FieldColumn::pass(pass)] = weights[pass];
    }
  };
  const double x = model.at(P::CenterX, 0);
  const double y = model.at(P::CenterY, 0);
  by(parameter) = parameter == P::Gain ? 1.0 / model.at(P::Gain, channel) : 1.0;
  if (parameter == P::GradientBend && hasDirection(shape))
  {
    // (a x + b y)^2 out of x^2 + y^2, x^2 - y^2 and x y, a^2 + b^2 = 1
    const double a = shape.gradientRight;
    const double b = shape.gradientDown;
    by(P::GradientBend) = 0.0;
    by(P::Falloff) = -0.5;
    by(P::GradientRight) = x;
    by(P::GradientDown) = y;
    by(P::Gain) = -0.5 * (x * x + y * y);
    column[FieldColumn::saddle()] = 0.5 * (a * a - b * b);
    column[FieldColumn::diagonal()] = 2.0 * a * b;
  }
  if (parameter == P::Falloff)
  {
    // About another center than the model's: the same polynomial.
    const double right = shape.centerX - x;
    const double down = shape.centerY - y;
    by(P::GradientRight) = 2.0 * right;
    by(P::GradientDown) = 2.0 * down;
    by(P::Gain) = -(right * (shape.centerX + x) + down * (shape.centerY + y));
  }
  if (parameter == P::TailFraction)
  {
    surround(tailWeights(shape.radius));
  }
  if (parameter == P::TailRadius)
  {
    surround(model.at(P::TailFraction, channel) * tailSlope(shape.radius));
  }
  return column;
}

void fieldColumns(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, FieldScratch& scratch)
{
  using P = ImageParameter;
  const ImageWindow& window = block.window;
  const auto K = static_cast<std::size_t>(data.channels());
  const auto k = static_cast<std::size_t>(channel);
  const std::vector<double> factors = fieldFactors(data, model, window);
  findNeighbours(data, model, glare, block, channel, factors, scratch);
  const BlockLight light(data, model, glare, block, channel, true);
  scratch.lastBlock = &block;
  scratch.lastChannel = channel;
  scratch.signal.resize(window.pixels());
  scratch.pixel.clear();
  for (std::size_t i = 0; i < window.pixels(); ++i)
  {
    scratch.signal[i] = light.signal(static_cast<int>(i), factors[i]);
    if (std::isfinite(block.real[i * K + k]))
    {
      scratch.pixel.push_back(static_cast<int>(i));
    }
  }
  const FieldDetector detector(model, channel);
  const FieldLines rows(model, true, channel, block.fold, window.y, window.height);
  const FieldLines columns(model, false, channel, block.fold, window.x, window.width);
  const double gain = model.at(P::Gain, channel);
  const double retained = model.at(P::Retained, channel);
  const double fromPrevious = channel > 0 ? model.at(P::FromPrevious, channel) : 0.0;
  const double fromNext = channel + 1 < data.channels() ? model.at(P::FromNext, channel) : 0.0;
  const auto count = static_cast<Eigen::Index>(scratch.pixel.size());
  scratch.columns.setZero(count, FieldColumn::count());
  scratch.level.resize(count);
  for (Eigen::Index n = 0; n < count; ++n)
  {
    const int i = scratch.pixel[static_cast<std::size_t>(n)];
    const auto at = static_cast<std::size_t>(i);
    const int column = i % window.width;
    const int row = i / window.width;
    const double x = data.pair.fieldX(window.x + column);
    const double y = data.pair.fieldY(window.y + row);
    const double bands = 1.0 + rows.factor[row] + columns.factor[column];
    const double added = rows.added[row] + columns.added[column];
    const double chain = gain * bands;
    const double before = scratch.before[at];
    const double self = scratch.signal[at];
    const double fromBefore = channel > 0 ? before - self : 0.0;
    const double fromBehind = channel + 1 < data.channels() ? scratch.next[at] - self : 0.0;
    const double lit = self + retained * before + fromPrevious * fromBefore + fromNext * fromBehind;
    const double linear = chain * lit + gain * added;
    const DetectorAnswer answer = detector(linear);
    const double u = answer.bySignal * linear;
    const double through = answer.bySignal * chain * light.lost();
    const double lens = light.light(i, factors[at]);
    const double direct = through * lens; // what the field's factors act on
    const double local = through * factors[at];
    const double sharp = local * (1.0 - light.fraction());
    auto out = scratch.columns.row(n);
    const auto by = [&out](P parameter) -> double& { return out[FieldColumn::of(parameter)]; };
    by(P::Gain) = u;
    by(P::Dark) = answer.byOffset;
    const double even = direct / std::fmax(model.gradient(x, y), LeastFactor);
    const GradientSlope slope = gradientSlope(model, x, y);
    by(P::GradientRight) = slope.right * even;
    by(P::GradientDown) = slope.down * even;
    by(P::GradientBend) = slope.bend * even;
    const double offX = x - model.at(P::CenterX, 0);
    const double offY = y - model.at(P::CenterY, 0);
    const double square = offX * offX + offY * offY;
    const double bright = direct / std::fmax(model.vignetting(x, y), LeastFactor);
    by(P::Falloff) = -square * bright;
    by(P::Fourth) = -square * square * bright;
    by(P::Sixth) = -square * square * square * bright;
    const double steep = 2.0 * bright *
      (model.at(P::Falloff, 0) +
        square * (2.0 * model.at(P::Fourth, 0) + 3.0 * square * model.at(P::Sixth, 0)));
    by(P::CenterX) = offX * steep;
    by(P::CenterY) = offY * steep;
    by(P::Square) = answer.bySquare;
    by(P::Compression) = -answer.bySquare;
    by(P::Exponent) = answer.byExponent;
    by(P::Clip) = answer.byClip;
    by(P::ClipLevel) = answer.byClipLevel;
    by(P::Retained) = answer.bySignal * chain * before;
    by(P::FromPrevious) = answer.bySignal * chain * fromBefore;
    by(P::FromNext) = answer.bySignal * chain * fromBehind;
    by(P::Glare) = answer.bySignal * chain * glare[channel];
    by(P::ConservingGlare) = answer.bySignal * chain * (glare[channel] - lens);
    const double right = sharp * light.scene().right(column, row);
    const double down = sharp * light.scene().down(column, row);
    by(P::Right) = right;
    by(P::Down) = down;
    by(P::Magnification) =
      data.pair.offX(window.x + column) * right + data.pair.offY(window.y + row) * down;
    by(P::Rotation) =
      Degree * (data.pair.offX(window.x + column) * down - data.pair.offY(window.y + row) * right);
    by(P::BlurVariance) = sharp * light.scene().blur(column, row);
    for (std::size_t other = 0; other < imageLights().size(); ++other)
    {
      by(imageLight(other)) = answer.bySignal * chain * light.other(other, i);
    }
    const TailSurround surround = light.surround(i) - light.self(i);
    for (int pass = 0; pass < TailPasses; ++pass)
    {
      out[FieldColumn::pass(pass)] = local * surround[pass];
    }
    const double open = answer.bySignal * gain * lit; // without stripes
    by(P::RowSine) = rows.sine[row] * open;
    by(P::RowCosine) = rows.cosine[row] * open;
    by(P::RowGain) = rows.gain[row] * open;
    by(P::RowOffset) = rows.offset[row] * answer.bySignal * gain;
    by(P::ColumnSine) = columns.sine[column] * open;
    by(P::ColumnCosine) = columns.cosine[column] * open;
    by(P::ColumnGain) = columns.gain[column] * open;
    by(P::ColumnOffset) = columns.offset[column] * answer.bySignal * gain;
    out[FieldColumn::diagonal()] = x * y * direct;
    out[FieldColumn::saddle()] = (x * x - y * y) * direct;
    out[FieldColumn::residual()] = static_cast<double>(block.real[at * K + k]) - answer.value;
    scratch.level[n] = answer.value;
  }
}

} // namespace msi

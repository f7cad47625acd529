#include "Kernels/Gap/Field/FieldColumns.h"

#include "Kernels/Camera/Angle.h"
#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Gap/Field/FieldBlockLight.h"
#include "Kernels/Gap/Field/FieldDetector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace msi
{

namespace
{
constexpr double LeastFactor = 0.05; // of the field, where its derivatives are asked for

// The sines of the lines of a block.
struct Stripes
{
  ImageParameter bySine, byCosine;
  Eigen::ArrayXd sine, cosine; // empty without period

  Stripes(double period, int first, int lines, ImageParameter ofSine, ImageParameter ofCosine)
    : bySine(ofSine)
    , byCosine(ofCosine)
  {
    if (period > 0.0)
    {
      const Eigen::ArrayXd angle =
        TwoPi / period * Eigen::ArrayXd::LinSpaced(lines, first, first + lines - 1);
      sine = angle.sin();
      cosine = angle.cos();
    }
  }
  double factor(const FieldModel& model, Eigen::Index channel, int line) const
  {
    return sine.size() == 0
      ? 0.0
      : model.at(bySine, channel) * sine[line] + model.at(byCosine, channel) * cosine[line];
  }
};

// The numbers of the lines of a block; null without a profile.
const double* linesOf(const Eigen::ArrayXXd* profile, int first, Eigen::Index channel)
{
  return profile == nullptr ? nullptr : &(*profile)(first, channel);
}

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
  const Stripes rows(model.rowPeriod, window.y, window.height, P::RowSine, P::RowCosine);
  const Stripes columns(model.columnPeriod, window.x, window.width, P::ColumnSine, P::ColumnCosine);
  const double gain = model.at(P::Gain, channel);
  const double retained = model.at(P::Retained, channel);
  const double fromPrevious = channel > 0 ? model.at(P::FromPrevious, channel) : 0.0;
  const double fromNext = channel + 1 < data.channels() ? model.at(P::FromNext, channel) : 0.0;
  const double* rowGain =
    linesOf(model.rows ? &model.rows->gainFor(block.fold) : nullptr, window.y, channel);
  const double* rowOffset =
    linesOf(model.rows ? &model.rows->offsetFor(block.fold) : nullptr, window.y, channel);
  const double* columnGain =
    linesOf(model.columns ? &model.columns->gainFor(block.fold) : nullptr, window.x, channel);
  const double* columnOffset =
    linesOf(model.columns ? &model.columns->offsetFor(block.fold) : nullptr, window.x, channel);
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
    double bands = 1.0 + rows.factor(model, channel, row) + columns.factor(model, channel, column);
    double added = 0.0;
    if (rowGain != nullptr)
    {
      bands += model.at(P::RowGain, channel) * rowGain[row];
      added += model.at(P::RowOffset, channel) * rowOffset[row];
    }
    if (columnGain != nullptr)
    {
      bands += model.at(P::ColumnGain, channel) * columnGain[column];
      added += model.at(P::ColumnOffset, channel) * columnOffset[column];
    }
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
    if (model.rowPeriod > 0.0)
    {
      by(P::RowSine) = rows.sine[row] * open;
      by(P::RowCosine) = rows.cosine[row] * open;
    }
    if (model.columnPeriod > 0.0)
    {
      by(P::ColumnSine) = columns.sine[column] * open;
      by(P::ColumnCosine) = columns.cosine[column] * open;
    }
    if (rowGain != nullptr)
    {
      by(P::RowGain) = rowGain[row] * open;
      by(P::RowOffset) = rowOffset[row] * answer.bySignal * gain;
    }
    if (columnGain != nullptr)
    {
      by(P::ColumnGain) = columnGain[column] * open;
      by(P::ColumnOffset) = columnOffset[column] * answer.bySignal * gain;
    }
    out[FieldColumn::diagonal()] = x * y * direct;
    out[FieldColumn::saddle()] = (x * x - y * y) * direct;
    out[FieldColumn::residual()] = static_cast<double>(block.real[at * K + k]) - answer.value;
    scratch.level[n] = answer.value;
  }
}

} // namespace msi

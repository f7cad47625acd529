#include "Kernels/Gap/Field/FieldColumns.h"

#include "Kernels/Gap/Field/FieldBlockLight.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace msi
{

namespace
{
// The axes of each column.
std::vector<unsigned> axesOfColumns()
{
  std::vector<unsigned> axes;
  for (const PlacedStep& step : imageSteps())
  {
    for (const ImageNumber& number : step.step->numbers)
    {
      axes.push_back(number.axes);
    }
    axes.insert(axes.end(), step.step->further.begin(), step.step->further.end());
  }
  return axes;
}

int columnWith(unsigned axes)
{
  static const std::vector<unsigned> all = axesOfColumns();
  return static_cast<int>(std::find(all.begin(), all.end(), axes) - all.begin());
}

using Light = std::shared_ptr<const BlockLight>;

// Null of a channel that is not there.
Light lightOf(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel)
{
  return channel >= 0 && channel < data.channels()
    ? std::make_shared<const BlockLight>(data, model, glare, block, channel)
    : nullptr;
}

// In every pixel of a block; 0 where there is no light.
std::vector<double> signalOf(const Light& light, const FieldBlock& block)
{
  std::vector<double> signal(block.window.pixels(), 0.0);
  for (std::size_t i = 0; light && i < signal.size(); ++i)
  {
    signal[i] = light->signal(static_cast<int>(i));
  }
  return signal;
}
}

int FieldColumn::residual()
{
  static const int columns = static_cast<int>(axesOfColumns().size());
  return columns;
}

std::vector<int> FieldColumn::of(unsigned axis)
{
  const std::vector<unsigned> axes = axesOfColumns();
  std::vector<int> columns;
  for (std::size_t c = 0; c < axes.size(); ++c)
  {
    if ((axes[c] & axis) != 0)
    {
      columns.push_back(static_cast<int>(c));
    }
  }
  return columns;
}

int FieldColumn::gain()
{
  return columnWith(ImageAxis::Channel | ImageAxis::Level);
}

int FieldColumn::offset()
{
  return columnWith(ImageAxis::Channel);
}

Eigen::VectorXd columnsChanged(
  ImageParameter parameter, const FieldModel& model, const FieldModel& about, Eigen::Index channel)
{
  const PlacedStep& step = stepOf(parameter);
  const auto n = static_cast<int>(parameter - step.number);
  Eigen::VectorXd column = Eigen::VectorXd::Zero(FieldColumn::residual());
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

void fieldColumns(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, FieldScratch& scratch)
{
  const ImageWindow& window = block.window;
  const auto K = static_cast<std::size_t>(data.channels());
  const auto k = static_cast<std::size_t>(channel);
  const auto lightIn = [&](Eigen::Index k) { return lightOf(data, model, glare, block, k); };
  if (scratch.lastBlock == &block && scratch.lastChannel == channel - 1)
  {
    scratch.before = std::move(scratch.signal);
    scratch.signal = std::move(scratch.next);
    scratch.light = std::move(scratch.nextLight);
  }
  else
  {
    scratch.before = signalOf(lightIn(channel - 1), block);
    scratch.light = lightIn(channel);
    scratch.signal = signalOf(scratch.light, block);
  }
  scratch.nextLight = lightIn(channel + 1);
  scratch.next = signalOf(scratch.nextLight, block);
  scratch.lastBlock = &block;
  scratch.lastChannel = channel;
  const BlockLight& light = *scratch.light;
  scratch.pixel.clear();
  for (std::size_t i = 0; i < window.pixels(); ++i)
  {
    if (std::isfinite(block.real[i * K + k]))
    {
      scratch.pixel.push_back(static_cast<int>(i));
    }
  }
  const FieldLines rows(model, true, channel, block.fold, window.y, window.height);
  const FieldLines columns(model, false, channel, block.fold, window.x, window.width);
  const auto count = static_cast<Eigen::Index>(scratch.pixel.size());
  scratch.columns.resize(count, FieldColumn::count());
  scratch.level.resize(count);
  const ChannelSteps behind =
    model.steps(ImageStage::Exposure, ImageStage::Detector, channel, true);
  StepDerivatives by;
  for (Eigen::Index n = 0; n < count; ++n)
  {
    const int i = scratch.pixel[static_cast<std::size_t>(n)];
    const auto at = static_cast<std::size_t>(i);
    ImagePixel pixel = light.pixel(i);
    pixel.previous = channel > 0 ? &scratch.before[at] : nullptr;
    pixel.next = channel + 1 < data.channels() ? &scratch.next[at] : nullptr;
    pixel.row = rows[i / window.width];
    pixel.column = columns[i % window.width];
    pixel.self = light.signal(i, pixel, by);
    const double answer = run(behind, pixel, nullptr, pixel.self, &by);
    by.chain();
    scratch.columns.row(n).head(FieldColumn::residual()) =
      Eigen::Map<const Eigen::RowVectorXd>(by.values.data(), FieldColumn::residual());
    scratch.columns(n, FieldColumn::residual()) =
      static_cast<double>(block.real[at * K + k]) - answer;
    scratch.level[n] = answer;
  }
}

std::vector<FieldResidual> fieldResiduals(
  const FieldData& data, const FieldModel& model, const FieldLoop& loop)
{
  const Eigen::Index K = data.channels();
  const Eigen::ArrayXd glare = sceneMean(data, model);
  std::vector<FieldResidual> residuals(data.blocks.size() * static_cast<std::size_t>(K));
  loop(static_cast<int>(data.blocks.size()),
    [&](int b)
    {
      const FieldBlock& block = data.blocks[static_cast<std::size_t>(b)];
      FieldScratch scratch;
      for (Eigen::Index k = 0; block.fold >= 0 && k < K; ++k)
      {
        fieldColumns(data, model, glare, block, k, scratch);
        residuals[static_cast<std::size_t>(b * K + k)] = { scratch.pixel, scratch.level,
          scratch.columns.col(FieldColumn::gain()), scratch.columns.col(FieldColumn::residual()) };
      }
    });
  return residuals;
}

} // namespace msi

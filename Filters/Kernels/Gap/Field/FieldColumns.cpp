#include "Kernels/Gap/Field/FieldColumns.h"

#include "Kernels/Gap/Field/FieldBlockLight.h"

#include <algorithm>
#include <cmath>
#include <memory>
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

// The step that has a column.
AskedSteps stepWith(int column)
{
  AskedSteps asked;
  for (const PlacedStep& step : imageSteps())
  {
    const auto first = static_cast<int>(step.column);
    asked.push_back(column >= first && column < first + static_cast<int>(step.step->width()));
  }
  return asked;
}

using Light = std::unique_ptr<const BlockLight>;

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

void forColumns(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, const AskedSteps& asked,
  const std::function<void(Eigen::Index, ChannelColumns&)>& act)
{
  const ImageWindow& window = block.window;
  const auto K = static_cast<std::size_t>(data.channels());
  const auto lightIn = [&](Eigen::Index channel)
  {
    return channel < data.channels()
      ? std::make_unique<const BlockLight>(data, model, glare, block, channel, asked)
      : nullptr;
  };
  // The light in this channel, and the signal of every pixel in it and in the channels beside it.
  Light light = lightIn(0);
  std::vector<double> before;
  std::vector<double> signal = signalOf(light, block);
  ChannelColumns found;
  for (Eigen::Index channel = 0; channel < data.channels(); ++channel)
  {
    const auto k = static_cast<std::size_t>(channel);
    Light nextLight = lightIn(channel + 1);
    std::vector<double> next = signalOf(nextLight, block);
    StepDerivatives by;
    found.pixel.clear();
    for (std::size_t i = 0; i < window.pixels(); ++i)
    {
      if (std::isfinite(block.real[i * K + k]))
      {
        found.pixel.push_back(static_cast<int>(i));
      }
    }
    const FieldLines rows(model, true, channel, block.fold, window.y, window.height);
    const FieldLines columns(model, false, channel, block.fold, window.x, window.width);
    const auto count = static_cast<Eigen::Index>(found.pixel.size());
    found.columns.resize(count, FieldColumn::count());
    found.level.resize(count);
    const ChannelSteps behind =
      model.steps(ImageStage::Exposure, ImageStage::Detector, channel, asked);
    for (Eigen::Index n = 0; n < count; ++n)
    {
      const int i = found.pixel[static_cast<std::size_t>(n)];
      const auto at = static_cast<std::size_t>(i);
      ImagePixel pixel = light->pixel(i);
      pixel.previous = channel > 0 ? &before[at] : nullptr;
      pixel.next = channel + 1 < data.channels() ? &next[at] : nullptr;
      pixel.row = rows[i / window.width];
      pixel.column = columns[i % window.width];
      pixel.self = light->signal(i, pixel, by);
      const double answer = run(behind, pixel, nullptr, pixel.self, &by);
      by.chain();
      found.columns.row(n).head(FieldColumn::residual()) =
        Eigen::Map<const Eigen::RowVectorXd>(by.values.data(), FieldColumn::residual());
      found.columns(n, FieldColumn::residual()) =
        static_cast<double>(block.real[at * K + k]) - answer;
      found.level[n] = answer;
    }
    act(channel, found);
    before = std::move(signal);
    signal = std::move(next);
    light = std::move(nextLight);
  }
}

std::vector<FieldResidual> fieldResiduals(
  const FieldData& data, const FieldModel& model, const FieldLoop& loop)
{
  const Eigen::Index K = data.channels();
  const Eigen::ArrayXd glare = data.cells.mean(model);
  const AskedSteps gain = stepWith(FieldColumn::gain());
  std::vector<FieldResidual> residuals(data.blocks.size() * static_cast<std::size_t>(K));
  loop(static_cast<int>(data.blocks.size()),
    [&](int b)
    {
      const FieldBlock& block = data.blocks[static_cast<std::size_t>(b)];
      if (block.fold < 0)
      {
        return;
      }
      forColumns(data, model, glare, block, gain,
        [&](Eigen::Index k, const ChannelColumns& found)
        {
          residuals[static_cast<std::size_t>(b * K + k)] = { found.pixel, found.level,
            found.columns.col(FieldColumn::gain()), found.columns.col(FieldColumn::residual()) };
        });
    });
  return residuals;
}

} // namespace msi

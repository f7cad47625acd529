#include "Kernels/Gap/Field/FieldModel.h"

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <cmath>

namespace msi
{

std::size_t fieldParameterCount()
{
  const PlacedStep& last = imageSteps().back();
  return last.number + last.step->numbers.size();
}

const ImageNumber& numberOf(ImageParameter parameter)
{
  const PlacedStep& step = stepOf(parameter);
  return step.step->numbers[parameter - step.number];
}

bool isShape(ImageParameter parameter)
{
  const ImagePull pull = numberOf(parameter).pull;
  return pull == ImagePull::Kept || pull == ImagePull::Found;
}

StepDerivatives::StepDerivatives()
  : values(imageSteps().back().column + imageSteps().back().step->width(), 0.0)
  , slopes(imageSteps().size(), 1.0)
{
}

void StepDerivatives::chain(const ChannelSteps& steps) noexcept
{
  double slope = 1.0;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
  {
    double* own = values.data() + step->placed->column;
    std::for_each(
      own, own + step->placed->step->width(), [slope](double& value) { value *= slope; });
    slope *= slopes[step->place];
  }
}

FieldModel::FieldModel(Eigen::Index channels)
  : Values(fieldParameterCount(), channels)
{
  for (ImageParameter p = 0; p < fieldParameterCount(); ++p)
  {
    (*this)[p].setConstant(numberOf(p).neutral);
  }
}

bool FieldModel::take(const FieldModel& other, bool (*which)(ImageParameter))
{
  const Eigen::ArrayXXd before = Values;
  for (ImageParameter p = 0; p < fieldParameterCount(); ++p)
  {
    if (which(p))
    {
      (*this)[p] = other[p];
    }
  }
  return (Values != before).any();
}

bool FieldModel::isNeutral(ImageParameter parameter) const
{
  return ((*this)[parameter] == numberOf(parameter).neutral).all();
}

bool FieldModel::isNeutral(const PlacedStep& step, Eigen::Index channel) const
{
  for (std::size_t n = 0; n < step.step->numbers.size(); ++n)
  {
    const ImageNumber& number = step.step->numbers[n];
    if (number.pull == ImagePull::Neutral && at(step.number + n, channel) != number.neutral)
    {
      return false;
    }
  }
  return true;
}

bool FieldModel::isNeutral(const PlacedStep& step) const
{
  bool neutral = true;
  for (Eigen::Index k = 0; k < Values.cols(); ++k)
  {
    neutral = neutral && isNeutral(step, k);
  }
  return neutral;
}

AskedSteps everyStep()
{
  AskedSteps asked;
  for (const PlacedStep& step : imageSteps())
  {
    asked.insert(&step);
  }
  asked.erase(&remainderStep());
  return asked;
}

const PlacedStep& remainderStep()
{
  return stepOf(effectWith(EffectTrait::Remainder).imageForms.front().terms.front().parameter);
}

ChannelSteps FieldModel::steps(
  ImageStage first, ImageStage last, Eigen::Index channel, const AskedSteps& asked) const
{
  const std::vector<PlacedStep>& known = imageSteps();
  ChannelSteps steps;
  std::size_t light = 0;
  for (std::size_t s = 0; s < known.size(); ++s)
  {
    const ImageStage stage = known[s].step->stage;
    if (stage >= first && stage <= last &&
      (!isNeutral(known[s], channel) || asked.count(&known[s]) > 0))
    {
      steps.push_back({ &known[s], numbers(known[s], channel), s, light });
    }
    light += known[s].from != nullptr ? 1 : 0;
  }
  return steps;
}

double run(const ChannelSteps& steps, ImagePixel& pixel, const double* others, double signal,
  StepDerivatives* derivatives)
{
  for (const ChannelStep& step : steps)
  {
    if (step.placed->from != nullptr)
    {
      pixel.elsewhere = others[step.light];
    }
    const auto apply = step.placed->step->apply;
    if (derivatives == nullptr)
    {
      apply(step.numbers, pixel, signal, nullptr);
      continue;
    }
    derivatives->slopes[step.place] =
      apply(step.numbers, pixel, signal, derivatives->values.data() + step.placed->column);
  }
  return signal;
}

double FieldFactor::operator()(double x, double y) const
{
  ImagePixel pixel;
  pixel.x = x;
  pixel.y = y;
  return run(Steps, pixel, nullptr, 1.0);
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

SceneChange FieldModel::ofScene(Eigen::Index channel) const
{
  SceneChange change;
  for (const PlacedStep& placed : imageSteps())
  {
    const ImageStep& step = *placed.step;
    const double* own = numbers(placed, channel);
    if (step.displace != nullptr)
    {
      step.displace(own, change.displacement);
    }
    if (step.tail != nullptr)
    {
      step.tail(own, change.tailWeights.data());
    }
    change.blurVariance += step.blurVariance != nullptr ? step.blurVariance(own) : 0.0;
  }
  return change;
}

FieldLines::FieldLines(
  const FieldModel& model, bool ofRows, Eigen::Index channel, int fold, int first, int count)
  : Lines(Eigen::ArrayX4d::Zero(count, 4))
{
  const FieldStripes& stripes = model.stripes(ofRows);
  if (stripes.period > 0.0)
  {
    const Eigen::ArrayXd angle =
      TwoPi / stripes.period * Eigen::ArrayXd::LinSpaced(count, first, first + count - 1);
    Lines.col(0) = angle.sin();
    Lines.col(1) = angle.cos();
  }
  if (stripes.profile != nullptr)
  {
    Lines.col(2) =
      FieldProfile::without(fold, stripes.profile->gain).col(channel).segment(first, count);
    Lines.col(3) =
      FieldProfile::without(fold, stripes.profile->offset).col(channel).segment(first, count);
  }
}

} // namespace msi

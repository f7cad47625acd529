// The numbers of everything that an image pair can show, and what they do to a pixel.
#pragma once

#include "Kernels/Camera/ImageTerm.h"
#include "Kernels/Gap/Field/FieldPair.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace msi
{

// Stripes of any shape: a number for each line and channel, lines x K. One such array for each fold, without what that fold's
// blocks say, and last one from all of them.
struct FieldProfile
{
  std::vector<Eigen::ArrayXXd> gain, offset;

  // fold: -1 for blocks outside all folds.
  static const Eigen::ArrayXXd& without(int fold, const std::vector<Eigen::ArrayXXd>& folds)
  {
    return fold < 0 ? folds.back() : folds[fold];
  }
};

struct FieldStripes
{
  double period = 0.0; // pixels; 0: none
  double periodError = 0.0;
  std::shared_ptr<const FieldProfile> profile; // null: none
};

// A step with its numbers of one channel.
struct ChannelStep
{
  const PlacedStep* placed;
  const double* numbers;
  std::size_t place; // among all steps
  std::size_t light; // among those that bring light from elsewhere
};
using ChannelSteps = std::vector<ChannelStep>;

// Derivatives of a pixel's answer: those of every step (PlacedStep::column), and each step's own by its signal.
struct StepDerivatives
{
  std::vector<double> values, slopes;

  StepDerivatives();
  // From derivatives of the result of each of these steps to those of the last one's.
  void chain(const ChannelSteps& steps) noexcept;
};

// Of all steps, those whose derivatives are asked for where they change nothing; elsewhere they are always given.
using AskedSteps = std::set<const PlacedStep*>;
AskedSteps everyStep();            // but remainderStep()
const PlacedStep& remainderStep(); // of EffectTrait::Remainder

// The signal behind these steps. others: light from elsewhere, of each step that brings it.
double run(const ChannelSteps& steps, ImagePixel& pixel, const double* others, double signal,
  StepDerivatives* derivatives = nullptr);

// What comes before the steps run, in a channel.
struct SceneChange
{
  ImageDisplacement displacement{};
  double blurVariance = 0.0;
  std::array<double, TailPasses> tailWeights{};
};

// One number of each parameter for every channel; parameters common to the channels repeat.
struct FieldModel
{
  explicit FieldModel(Eigen::Index channels = 0);

  auto operator[](ImageParameter parameter) { return Values.row(parameter).transpose(); }
  auto operator[](ImageParameter parameter) const { return Values.row(parameter).transpose(); }
  double at(ImageParameter parameter, Eigen::Index channel) const
  {
    return Values(parameter, channel);
  }
  Eigen::Index channels() const noexcept { return Values.cols(); }
  const double* numbers(const PlacedStep& step, Eigen::Index channel) const
  {
    return &Values(step.number, channel);
  }
  bool isNeutral(ImageParameter parameter) const;
  // But for numbers that change nothing alone.
  bool isNeutral(const PlacedStep& step) const;
  bool isNeutral(const PlacedStep& step, Eigen::Index channel) const;

  // The parameters for which `which` is true. Returns whether one of them was another.
  bool take(const FieldModel& other, bool (*which)(ImageParameter));
  void goHalfwayTo(const FieldModel& other) { Values = 0.5 * (Values + other.Values); }

  // The steps of these stages that change something or are asked for. They refer to the model.
  ChannelSteps steps(
    ImageStage first, ImageStage last, Eigen::Index channel, const AskedSteps& asked = {}) const;

  SceneChange ofScene(Eigen::Index channel) const;

  FieldStripes rows, columns;
  FieldStripes& stripes(bool ofRows) noexcept { return ofRows ? rows : columns; }
  const FieldStripes& stripes(bool ofRows) const noexcept { return ofRows ? rows : columns; }

private:
  Eigen::ArrayXXd Values; // parameters x K
};

// The factor over the field, the same in all channels. Refers to the model.
class FieldFactor
{
public:
  explicit FieldFactor(const FieldModel& model)
    : Steps(model.steps(ImageStage::Lens, ImageStage::Lens, 0))
  {
  }
  double operator()(double x, double y) const;

private:
  ChannelSteps Steps;
};

// Appends the light at the places from where it falls on a pixel, too: of the unmoved, unblurred scene.
void addElsewhere(const FieldPair& pair, const float* scene, const FieldFactor& factor,
  const ImagePlace& pixel, std::size_t channel, std::vector<double>& others);

// The stripes of `count` rows, or columns, of one channel from `first` on.
struct FieldLines
{
  // fold: FieldProfile::without.
  FieldLines(
    const FieldModel& model, bool ofRows, Eigen::Index channel, int fold, int first, int count);

  ImageLine operator[](Eigen::Index line) const
  {
    return { Lines(line, 0), Lines(line, 1), Lines(line, 2), Lines(line, 3) };
  }

private:
  Eigen::ArrayX4d Lines; // in the order of ImageLine
};

std::size_t fieldParameterCount();
const ImageNumber& numberOf(ImageParameter parameter);
// Kept or found.
bool isShape(ImageParameter parameter);

} // namespace msi

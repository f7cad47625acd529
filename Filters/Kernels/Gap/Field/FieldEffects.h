// The effects of the library that an image pair can show, and how the library writes down what was found.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Gap/Diagnosis/LinearFit.h"
#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/GapReport.h"

#include <Eigen/Core>

#include <algorithm>
#include <string>
#include <vector>

namespace msi
{

// One form of one effect.
struct FieldChoice : ImageForm
{
  const EffectDefinition* effect;

  bool has(EffectTrait::Bit trait) const noexcept { return effect->has(trait); }
  const PlacedStep& step() const { return stepOf(terms.front().parameter); }
  ImageStage stage() const { return step().step->stage; }
};

// Every effect that an image pair can show, without those named.
std::vector<FieldChoice> fieldChoices(const std::vector<std::string>& without);

// Stripes of rows or columns.
bool isBanding(const FieldChoice& choice);
// Stripes by a FieldProfile.
bool isProfile(const FieldChoice& choice);
// And an offset of each line instead of a gain.
bool isOffset(const FieldChoice& choice);
// Stripes of rows, not of columns.
bool isOfRows(const FieldChoice& choice);

using FieldSet = std::vector<const FieldChoice*>;

template <typename Condition>
bool hasChoice(const FieldSet& set, Condition condition)
{
  return std::any_of(
    set.begin(), set.end(), [&](const FieldChoice* choice) { return condition(*choice); });
}

// One of the numbers that a set has to fit: terms in order, channels within a term that has a number for each.
struct FieldNumber : FreeNumber
{
  const ImageTerm* term;
  Eigen::Index channel; // -1: common to all
};
// Where a model has them; those of shapes, which no prior pulls, want to stay there.
std::vector<FieldNumber> numbersOf(const FieldSet& set, const FieldModel& model);

// Whether a form has all numbers of another one of its effect, and more.
bool extends(const FieldChoice& choice, const FieldChoice& other);
// Neither the same effect nor parameters in common, but for forms that it extends.
bool compatible(const FieldSet& set, const FieldChoice& choice);
AskedSteps stepsOf(const FieldSet& set);

// error: standard errors of the choice's numbers, from `next` on (FieldFitter::standardErrors), which moves on.
std::vector<GapParameter> fieldParameters(const FieldChoice& choice, const FieldModel& model,
  const std::vector<std::string>& channels, const Eigen::VectorXd& error, Eigen::Index& next);

// The set as a list for CameraSimulator and ImageSimulator.
std::vector<CameraEffect> fieldCorrection(
  const FieldSet& set, const FieldModel& model, const std::vector<std::string>& channels);

} // namespace msi

// A hypothesis about the camera: some effects, some of their parameters free.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/SampleScene.h"
#include "Kernels/Camera/StagedResponse.h"
#include "Kernels/Gap/Diagnosis/LinearFit.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// One form of one effect that may be tried.
struct EffectChoice
{
  const EffectDefinition* effect = nullptr;
  const EffectForm* form = nullptr;
  std::string medium;
  // The white was taken with this effect in place: CameraSimulatorOptions::whiteAfterEffects.
  bool whiteAfter = false;
  // With a level of its own: a lamp that changes its color also changes its brightness. The library's forms of
  // such an effect hold the brightness; a gain of all channels carries it in the simulator.
  bool leveled = false;
};

struct FreeParameter : FreeNumber
{
  std::size_t effect;   // in EffectSet::effects; their number for the level
  std::size_t index;    // in CameraEffect::parameters
  Eigen::Index channel; // -1: common to all channels
  const EffectParameter* definition;
  std::string name;
};

// The parameter that says when a step takes place: its index in CameraEffect::parameters, that of its width behind it.
struct StepPlace
{
  std::size_t index;
  const EffectParameter* parameter;
};

struct EffectSet
{
  std::vector<EffectChoice> choices;
  std::vector<CameraEffect> effects; // one a choice
  std::vector<char> secondaryFree;   // one a choice
  double level = 1.0;                // of the choices that are leveled

  std::size_t size() const noexcept { return effects.size(); }
  bool whiteAfterEffects() const noexcept;
  bool leveled() const noexcept; // and no gain of all channels is there to do it
  std::size_t steps() const;     // places of steps in time: found by search, not by derivative
  // How many channels away the parameters of one channel act.
  Eigen::Index reach() const noexcept;
  // What the simulator is to run with.
  std::vector<CameraEffect> simulated() const;
  // Added at its neutral values, or at `start`: one number a parameter of the form, or all numbers of the effect.
  void add(
    const EffectChoice& choice, const CameraModel& camera, const std::vector<double>& start = {});
  void remove(std::size_t position);
  std::optional<StepPlace> placeOf(std::size_t position) const; // empty: it makes no step
  std::vector<FreeParameter> freeParameters(const CameraModel& camera) const;
  double value(const FreeParameter& parameter) const;
  double& value(const FreeParameter& parameter);
};

// The set with its parameters changed, within their bounds.
EffectSet changed(
  EffectSet set, const std::vector<FreeParameter>& free, const Eigen::VectorXd& change);

// Noise-free response of the camera with these effects, of which a fit asks many that are alike. Empty where a channel is left without
// light.
std::optional<StagedResponse> stagedResponse(
  const CameraModel& camera, const SampleScene& scene, const EffectSet& set);
std::optional<StagedResponse> stagedResponse(const StagedResponse& related, const EffectSet& set);

// Of a response by one parameter, in the channels where it acts.
struct Derivative
{
  Eigen::Index first = 0;  // of these channels
  Eigen::MatrixXd changes; // channels x S

  // Of these rows of a K x S matrix those of the channels.
  template <typename Matrix>
  auto of(Matrix& all) const
  {
    return all.middleRows(first, changes.rows());
  }
};

// Of the response `here`, that of the set, by these of its parameters.
// Forward differences. The parameters of one channel move that channel only (with channel_crosstalk also
// its neighbours), so all channels are moved at once.
std::vector<Derivative> derivatives(
  const StagedResponse& here, const EffectSet& set, const std::vector<FreeParameter>& free);

// Whether this scene has what an effect needs. medium: of an effect of one.
bool canShow(const SampleScene& scene, const EffectDefinition& effect, const std::string& medium);

// The media of which there are several samples: without one of them the others can still show what the medium does.
std::vector<std::string> mediaOfSeveralSamples(const SampleScene& scene);

// The effects of the library that this scene can show in its mean response, form by form, without those named;
// those of lamp and filters also with the white taken after them.
std::vector<EffectChoice> choicesFor(
  const SampleScene& scene, const std::vector<std::string>& without);

} // namespace msi

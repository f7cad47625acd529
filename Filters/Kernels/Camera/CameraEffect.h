// The names, parameters and places of the effects that make a real camera differ from its model.
#pragma once

#include "Kernels/Camera/CaptureKind.h"
#include "Kernels/Camera/ImageTerm.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

// Where physics puts an effect. Effects act in this order; within a stage in the order of the library.
enum class EffectStage
{
  Reflectance,  // the light that one medium sends to the camera
  Responsivity, // lamp and filters: the matrix M
  Irradiance,   // geometry and stray light: what falls on the detector
  Detector,     // gains, coupling, curve, offset
  Noise,        // variance only
  Image         // needs the pixels of an image; does nothing on tables
};

// What an effect must be told beyond the samples' reflectance.
enum class EffectNeed
{
  Nothing,
  Medium,   // acts on the medium named in CameraEffect::medium
  Position, // SceneSamples::x, y
  Order     // SceneSamples::order
};

// One number of an effect, or one number for every channel.
struct EffectParameter
{
  std::string name;
  std::string unit;    // "1" for a plain ratio
  double neutral;      // with all its primary parameters at neutral an effect changes no bit
  double lower, upper; // bounds of a fit
  double typical;      // size of a clearly visible departure from neutral: the scale of a fit
  std::string meaning;
  bool perChannel = false;
  bool secondary =
    false; // shapes an effect that another parameter turns on; a fit may hold it at neutral
  bool searched = false; // has no useful derivative: a fit tries places instead
  bool given = false;    // follows from the data; not fitted
  // Of numbers of single channels: it is the light that makes them differ, so they are one cause and may follow a curve over the
  // channels.
  bool followsLight = false;

  // The same with a number for each channel.
  EffectParameter ofChannels() const
  {
    EffectParameter parameter = *this;
    parameter.perChannel = true;
    return parameter;
  }
  // The same with a number for each channel, which the light makes differ.
  EffectParameter ofLight() const
  {
    EffectParameter parameter = ofChannels();
    parameter.followsLight = true;
    return parameter;
  }
};

// What the diagnosis asks of a form. Bits of EffectForm::traits.
namespace FormTrait
{
enum Bit : unsigned
{
  None = 0,
  KeepsWhite = 1U << 0, // of lamp and filters: the response to white does not change
  Brightens = 1U << 1,  // unless the white is balanced, it contains a gain common to all channels
  Adds = 1U << 2,       // adds to the response instead of multiplying it
  // Its given parameters are slope and constant of the line through the squared responses. It acts before the effect's other
  // forms and may stand beside one of them: it is a matter of how the camera was fitted.
  BesideLine = 1U << 3,
  OfImages = 1U << 4, // for pairs of images, which know no spectra; tables have other forms
  OfField = 1U << 5   // needs positions, whatever the effect needs
};
}

// What the diagnosis asks of an effect. Bits of EffectDefinition::traits.
namespace EffectTrait
{
enum Bit : unsigned
{
  None = 0,
  Exact = 1U << 0,           // the formula is exact: a residual that remains has another cause
  CouplesChannels = 1U << 1, // the parameters of a channel act on its neighbours, too
  ActsOnEdges = 1U << 2,     // its forms approximate point spreads and resampling
  CommonGain = 1U << 3,      // one gain of all channels
  SpectralGain = 1U << 4,    // gains that follow a smooth curve over the channels
  LimitsResponse = 1U << 5,  // its first parameter is the largest response that passes
  Remainder = 1U << 6        // what all others leave: fitted last, and no cause
};
}

// One way to write an effect down: "common" (one number for all channels), "per_channel", ...
struct EffectForm
{
  std::string name;
  std::string meaning; // formula
  std::vector<EffectParameter> parameters;
  // Further starting points of a fit, one number a parameter (the same for every channel); for forms whose
  // error has more than one valley. May be empty.
  std::vector<std::vector<double>> starts = {};
  unsigned traits = FormTrait::None;

  bool has(FormTrait::Bit trait) const noexcept { return (traits & trait) != 0; }
};

struct EffectDefinition
{
  std::string name;
  std::string title;
  std::string meaning; // physics
  EffectStage stage;
  EffectNeed need;
  std::vector<EffectForm> forms; // the first is the default, the one with the fewest parameters
  CaptureKind separatingCapture; // shows this effect by itself
  unsigned traits = EffectTrait::None;
  std::vector<ImageForm> imageForms = {}; // what a pair of images shows of it; empty: nothing

  bool has(EffectTrait::Bit trait) const noexcept { return (traits & trait) != 0; }
  // With one number for all channels.
  bool hasCommonForm() const noexcept
  {
    const std::vector<EffectParameter>& plain = forms.front().parameters;
    return std::none_of(
      plain.begin(), plain.end(), [](const EffectParameter& one) { return one.perChannel; });
  }
};

// Every effect the simulator knows, in the order in which they act.
const std::vector<EffectDefinition>& effectLibrary();

// nullptr where the name is not known. An empty form is the default form.
const EffectDefinition* findEffect(std::string_view name);
const EffectForm* findForm(const EffectDefinition& effect, std::string_view form) noexcept;
// Errors: std::invalid_argument for an unknown effect or form, listing those known.
const EffectDefinition& requireEffect(std::string_view name);
const EffectForm& requireForm(const EffectDefinition& effect, std::string_view form);
// The first effect of the library with a trait, of a stage. There must be one.
const EffectDefinition& effectWith(EffectTrait::Bit trait);
const EffectDefinition& effectOf(EffectStage stage);

// One effect at work, as data.
struct CameraEffect
{
  std::string name;
  std::string form;               // empty: the default form
  std::string medium;             // for effects that need a medium
  std::vector<double> parameters; // as effectParameters() lists them
};

// The single numbers of an effect: in the order of its form, a parameter that is per channel spread out
// and named "gain[550nm]". `parameters` of the effect is not looked at.
// Errors: std::invalid_argument for an unknown effect or form, listing those known.
std::vector<EffectParameter> effectParameters(
  const CameraEffect& effect, const std::vector<std::string>& channels);

// The effect with every parameter at its neutral value; errors as above.
CameraEffect neutralEffect(std::string_view name, const std::vector<std::string>& channels,
  std::string_view form = {}, std::string_view medium = {});

} // namespace msi

#include "Kernels/Camera/CameraEffect.h"

#include "Kernels/Camera/Effects/Effect.h"

#include <algorithm>
#include <cassert>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

// One file each.
using MakeEffect = Effect();
MakeEffect specularComponent, translucency, fluorescence, interreflection, mediumGain;
MakeEffect filterBandwidth, filterShift, filterLeak, illuminantDrift;
MakeEffect illuminationGradient, vignetting, veilingGlare, localStrayLight;
MakeEffect exposureGain, channelGain, channelCrosstalk, sessionDrift;
MakeEffect detectorNonlinearity, darkOffset, saturation, unmodelledResponse, excessNoise;
MakeEffect distortion, misregistration, defocus, ghostReflection, lag, banding;

namespace
{
template <typename Items>
[[noreturn]] void rejectName(const std::string& what, std::string_view name, const Items& known)
{
  std::ostringstream message;
  message << "there is no " << what << " '" << name << "'; known are ";
  const char* separator = "";
  for (const auto& item : known)
  {
    message << separator << item.name;
    separator = ", ";
  }
  throw std::invalid_argument(message.str());
}
}

namespace
{
struct Library
{
  std::vector<Effect> effects;
  std::vector<PlacedStep> steps;
};

// Effects that share a step share its numbers.
std::vector<PlacedStep> placedSteps(const std::vector<Effect>& effects)
{
  std::vector<PlacedStep> steps;
  for (const Effect& effect : effects)
  {
    const ImageStep* step = effect.onImage.step;
    if (step != nullptr &&
      std::none_of(
        steps.begin(), steps.end(), [step](const PlacedStep& other) { return other.step == step; }))
    {
      steps.push_back({ step, effect.onImage.lightFrom, 0, 0 });
    }
  }
  std::stable_sort(steps.begin(), steps.end(),
    [](const PlacedStep& a, const PlacedStep& b) { return a.step->stage < b.step->stage; });
  for (std::size_t s = 1; s < steps.size(); ++s)
  {
    steps[s].number = steps[s - 1].number + steps[s - 1].step->numbers.size();
    steps[s].column = steps[s - 1].column + steps[s - 1].step->width();
  }
  return steps;
}

// Counts the numbers of image forms among those of all steps.
void place(Effect& effect, const std::vector<PlacedStep>& steps)
{
  const auto own = std::find_if(steps.begin(), steps.end(),
    [&effect](const PlacedStep& step) { return step.step == effect.onImage.step; });
  if (own == steps.end() && !effect.definition.imageForms.empty())
  {
    throw std::logic_error(effect.definition.name + " has forms for images, but no step");
  }
  for (ImageForm& form : effect.definition.imageForms)
  {
    for (ImageTerm& term : form.terms)
    {
      term.parameter += own->number;
    }
  }
}

const Library& library()
{
  static const Library all = []
  {
    Library made;
    // In the order in which they act.
    for (MakeEffect* make :
      { specularComponent, translucency, fluorescence, interreflection, mediumGain, filterBandwidth,
        filterShift, filterLeak, illuminantDrift, illuminationGradient, vignetting, veilingGlare,
        localStrayLight, exposureGain, channelGain, channelCrosstalk, sessionDrift,
        detectorNonlinearity, darkOffset, saturation, unmodelledResponse, excessNoise, distortion,
        misregistration, defocus, ghostReflection, lag, banding })
    {
      made.effects.push_back(make());
    }
    made.steps = placedSteps(made.effects);
    for (Effect& effect : made.effects)
    {
      place(effect, made.steps);
    }
    return made;
  }();
  return all;
}
}

const std::vector<Effect>& effectRegistry()
{
  return library().effects;
}

const std::vector<PlacedStep>& imageSteps()
{
  return library().steps;
}

const PlacedStep& stepOf(ImageParameter parameter)
{
  const auto& steps = imageSteps();
  auto step = steps.begin();
  while (step + 1 != steps.end() && (step + 1)->number <= parameter)
  {
    ++step;
  }
  return *step;
}

ImageParameter imageParameter(std::string_view effect, std::string_view name)
{
  for (const ImageForm& form : requireEffect(effect).imageForms)
  {
    for (const ImageTerm& term : form.terms)
    {
      if (term.name == name)
      {
        return term.parameter;
      }
    }
  }
  std::vector<ImageTerm> known;
  for (const ImageForm& form : requireEffect(effect).imageForms)
  {
    known.insert(known.end(), form.terms.begin(), form.terms.end());
  }
  rejectName("number of " + std::string(effect) + " in images", name, known);
}

const std::vector<EffectDefinition>& effectLibrary()
{
  static const std::vector<EffectDefinition> library = []
  {
    std::vector<EffectDefinition> all;
    for (const Effect& effect : effectRegistry())
    {
      all.push_back(effect.definition);
    }
    return all;
  }();
  return library;
}

const Effect& registered(const EffectDefinition& definition)
{
  const auto position = static_cast<std::size_t>(&definition - effectLibrary().data());
  return effectRegistry()[position];
}

const EffectDefinition* findEffect(std::string_view name)
{
  const auto& library = effectLibrary();
  const auto found = std::find_if(library.begin(), library.end(),
    [name](const EffectDefinition& effect) { return effect.name == name; });
  return found == library.end() ? nullptr : &*found;
}

const EffectForm* findForm(const EffectDefinition& effect, std::string_view form) noexcept
{
  if (form.empty())
  {
    return &effect.forms.front();
  }
  const auto found = std::find_if(effect.forms.begin(), effect.forms.end(),
    [form](const EffectForm& candidate) { return candidate.name == form; });
  return found == effect.forms.end() ? nullptr : &*found;
}

const EffectDefinition& requireEffect(std::string_view name)
{
  const EffectDefinition* definition = findEffect(name);
  if (definition == nullptr)
  {
    rejectName("camera effect", name, effectLibrary());
  }
  return *definition;
}

const EffectForm& requireForm(const EffectDefinition& effect, std::string_view name)
{
  const EffectForm* form = findForm(effect, name);
  if (form == nullptr)
  {
    rejectName("form of " + effect.name, name, effect.forms);
  }
  return *form;
}

namespace
{
template <typename Condition>
const EffectDefinition& firstEffect(Condition condition)
{
  const auto& library = effectLibrary();
  const auto found = std::find_if(library.begin(), library.end(), condition);
  assert(found != library.end());
  return *found;
}
}

const EffectDefinition& effectWith(EffectTrait::Bit trait)
{
  return firstEffect([trait](const EffectDefinition& effect) { return effect.has(trait); });
}

const EffectDefinition& effectOf(EffectStage stage)
{
  return firstEffect([stage](const EffectDefinition& effect) { return effect.stage == stage; });
}

ImageStep stepOfLight()
{
  ImageStep step{ ImageStage::Light, { { 0.0, ImageAxis::Position } },
    [](const double* numbers, const ImagePixel& pixel, double& signal, double* by)
    {
      if (by != nullptr)
      {
        by[0] = pixel.elsewhere;
      }
      signal += numbers[0] * pixel.elsewhere;
      return 1.0;
    } };
  return step;
}

ImageTerm imageTerm(std::size_t number, const EffectParameter& of)
{
  ImageTerm term{ number, of.perChannel, of.lower, of.upper, of.typical, of.name, of.unit };
  term.followsLight = of.followsLight;
  return term;
}

std::vector<EffectParameter> effectParameters(
  const CameraEffect& effect, const std::vector<std::string>& channels)
{
  std::vector<EffectParameter> single;
  for (const EffectParameter& parameter :
    requireForm(requireEffect(effect.name), effect.form).parameters)
  {
    if (!parameter.perChannel)
    {
      single.push_back(parameter);
      continue;
    }
    for (const std::string& channel : channels)
    {
      single.push_back(parameter);
      single.back().name += "[" + channel + "]";
    }
  }
  return single;
}

CameraEffect neutralEffect(std::string_view name, const std::vector<std::string>& channels,
  std::string_view form, std::string_view medium)
{
  CameraEffect effect{ std::string(name), std::string(form), std::string(medium), {} };
  for (const EffectParameter& parameter : effectParameters(effect, channels))
  {
    effect.parameters.push_back(parameter.neutral);
  }
  return effect;
}

} // namespace msi

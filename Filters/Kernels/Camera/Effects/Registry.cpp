#include "Kernels/Camera/CameraEffect.h"

#include "Kernels/Camera/Effects/Effect.h"

#include <algorithm>
#include <iterator>
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

// The first of that name; nullptr: there is none.
template <typename Item>
const Item* named(const std::vector<Item>& items, std::string_view name) noexcept
{
  const auto found = std::find_if(
    items.begin(), items.end(), [name](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

struct Library
{
  std::vector<Effect> effects;
  std::vector<EffectDefinition> definitions; // of the effects
  std::vector<PlacedStep> steps;
};

// Effects that share a step share its numbers.
std::vector<PlacedStep> placedSteps(const std::vector<Effect>& effects)
{
  std::vector<PlacedStep> steps;
  for (const Effect& effect : effects)
  {
    for (const ImageStep* step : effect.onImage.steps)
    {
      if (std::none_of(steps.begin(), steps.end(),
            [step](const PlacedStep& other) { return other.step == step; }))
      {
        steps.push_back({ step, effect.onImage.lightFrom, 0, 0 });
      }
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
  std::vector<ImageParameter> numbers; // of the effect's steps
  for (const ImageStep* own : effect.onImage.steps)
  {
    const auto placed = std::find_if(
      steps.begin(), steps.end(), [own](const PlacedStep& step) { return step.step == own; });
    for (std::size_t n = 0; n < own->numbers.size(); ++n)
    {
      numbers.push_back(placed->number + n);
    }
  }
  for (ImageForm& form : effect.definition.imageForms)
  {
    for (ImageTerm& term : form.terms)
    {
      if (term.parameter >= numbers.size())
      {
        throw std::logic_error(effect.definition.name + " has a form for images, but no step");
      }
      term.parameter = numbers[term.parameter];
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
      made.definitions.push_back(effect.definition);
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
  const auto next = std::find_if(imageSteps().begin(), imageSteps().end(),
    [parameter](const PlacedStep& step) { return step.number > parameter; });
  return *std::prev(next);
}

ImageParameter imageParameter(std::string_view effect, std::string_view name)
{
  std::vector<ImageTerm> terms;
  for (const ImageForm& form : requireEffect(effect).imageForms)
  {
    terms.insert(terms.end(), form.terms.begin(), form.terms.end());
  }
  const ImageTerm* term = named(terms, name);
  if (term == nullptr)
  {
    rejectName("number of " + std::string(effect) + " in images", name, terms);
  }
  return term->parameter;
}

const std::vector<EffectDefinition>& effectLibrary()
{
  return library().definitions;
}

const Effect& registered(const EffectDefinition& definition)
{
  const auto position = static_cast<std::size_t>(&definition - effectLibrary().data());
  return effectRegistry()[position];
}

const EffectDefinition* findEffect(std::string_view name)
{
  return named(effectLibrary(), name);
}

const EffectForm* findForm(const EffectDefinition& effect, std::string_view form) noexcept
{
  return form.empty() ? &effect.forms.front() : named(effect.forms, form);
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

const EffectDefinition& effectWith(EffectTrait::Bit trait)
{
  return *std::find_if(effectLibrary().begin(), effectLibrary().end(),
    [trait](const EffectDefinition& effect) { return effect.has(trait); });
}

const EffectDefinition& effectOf(EffectStage stage)
{
  return *std::find_if(effectLibrary().begin(), effectLibrary().end(),
    [stage](const EffectDefinition& effect) { return effect.stage == stage; });
}

ImageStep stepOfLight()
{
  return { ImageStage::Light, { { 0.0, ImageAxis::Position } },
    [](const double* numbers, const ImagePixel& pixel, double& signal, double* by)
    {
      if (by != nullptr)
      {
        by[0] = pixel.elsewhere;
      }
      signal += numbers[0] * pixel.elsewhere;
      return 1.0;
    } };
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

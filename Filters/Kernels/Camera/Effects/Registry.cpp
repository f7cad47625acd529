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
MakeEffect detectorNonlinearity, darkOffset, saturation, excessNoise;
MakeEffect misregistration, defocus, ghostReflection, lag, banding;

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
// Gives the parameter of light from elsewhere its own number.
void numberLight(Effect& effect, std::size_t& lights)
{
  if (effect.onImage.lightFrom == nullptr)
  {
    return;
  }
  for (ImageForm& form : effect.definition.imageForms)
  {
    form.terms.front().parameter = imageLight(lights);
  }
  ++lights;
}
}

const std::vector<Effect>& effectRegistry()
{
  static const std::vector<Effect> registry = []
  {
    std::vector<Effect> effects;
    std::size_t lights = 0;
    // In the order in which they act.
    for (MakeEffect* make : { specularComponent, translucency, fluorescence, interreflection,
           mediumGain, filterBandwidth, filterShift, filterLeak, illuminantDrift,
           illuminationGradient, vignetting, veilingGlare, localStrayLight, exposureGain,
           channelGain, channelCrosstalk, sessionDrift, detectorNonlinearity, darkOffset,
           saturation, excessNoise, misregistration, defocus, ghostReflection, lag, banding })
    {
      effects.push_back(make());
      numberLight(effects.back(), lights);
    }
    return effects;
  }();
  return registry;
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

const std::vector<LightFrom>& imageLights()
{
  static const std::vector<LightFrom> lights = []
  {
    std::vector<LightFrom> all;
    for (const Effect& effect : effectRegistry())
    {
      if (effect.onImage.lightFrom != nullptr)
      {
        all.push_back(effect.onImage.lightFrom);
      }
    }
    return all;
  }();
  return lights;
}

const Effect& registered(const EffectDefinition& definition)
{
  const auto position = static_cast<std::size_t>(&definition - effectLibrary().data());
  return effectRegistry()[position];
}

const EffectDefinition* findEffect(std::string_view name) noexcept
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

std::string separatingCapture(std::string_view effect)
{
  const EffectDefinition* definition = findEffect(effect);
  return definition == nullptr ? std::string() : definition->separatingCapture;
}

ImageTerm imageTerm(ImageParameter parameter, const EffectParameter& of)
{
  return { parameter, of.perChannel, of.lower, of.upper, of.typical, of.name, of.unit };
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

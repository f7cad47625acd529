#include "Kernels/Camera/CameraEffect.h"

#include "Kernels/Camera/Effects/EffectEntry.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

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

const std::vector<EffectEntry>& effectEntries()
{
  static const std::vector<EffectEntry> entries = []
  {
    std::vector<EffectEntry> all;
    const auto append = [&all](std::vector<EffectEntry> stage)
    {
      all.insert(
        all.end(), std::make_move_iterator(stage.begin()), std::make_move_iterator(stage.end()));
    };
    append(reflectanceEffects());
    append(responsivityEffects());
    append(irradianceEffects());
    append(gainEffects());
    all.push_back(sessionDrift());
    append(detectorEffects());
    append(noiseEffects());
    append(imageEffects());
    return all;
  }();
  return entries;
}

const std::vector<EffectDefinition>& effectLibrary()
{
  static const std::vector<EffectDefinition> library = []
  {
    std::vector<EffectDefinition> all;
    for (const EffectEntry& entry : effectEntries())
    {
      all.push_back(entry.definition);
    }
    return all;
  }();
  return library;
}

const EffectEntry& entryOf(const EffectDefinition& definition)
{
  const auto position = static_cast<std::size_t>(&definition - effectLibrary().data());
  return effectEntries()[position];
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

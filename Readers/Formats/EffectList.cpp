#include "Formats/EffectList.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Text/JsonText.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace msi
{

namespace
{
using Json = JsonText::Json;

template <typename Items>
std::string namesOf(const Items& items)
{
  std::string names;
  for (const auto& item : items)
  {
    names += (names.empty() ? "" : ", ") + item.name;
  }
  return names;
}

const EffectParameter* findParameter(const EffectForm& form, const std::string& name)
{
  const auto found = std::find_if(form.parameters.begin(), form.parameters.end(),
    [&name](const EffectParameter& parameter) { return parameter.name == name; });
  return found == form.parameters.end() ? nullptr : &*found;
}

// One entry of the list.
class EffectReader
{
public:
  EffectReader(const JsonText& reader, const Json& entry, std::size_t index,
    const std::vector<std::string>& channels)
    : Reader(reader)
    , Entry(entry)
    , Index(index)
    , Channels(channels)
  {
  }

  CameraEffect read()
  {
    requireKeys();
    Name = text("effect").value_or("");
    Definition = findEffect(Name);
    if (Definition == nullptr)
    {
      const bool missing = JsonText::find(Entry, "effect") == nullptr;
      fail(missing ? "has no key 'effect'" : "there is no effect of this name",
        "one of " + namesOf(effectLibrary()), missing ? "name the effect" : "correct the name");
    }
    const Json* parameters = JsonText::find(Entry, "parameters");
    Parameters = parameters == nullptr ? Json::object() : *parameters;
    if (!Parameters.is_object())
    {
      fail(std::string("'parameters' holds ") + Parameters.type_name(),
        "an object with the parameters by name", "correct the entry");
    }
    renameFormer();
    readChannel();
    const EffectForm& form = chooseForm();
    CameraEffect effect{ Name, form.name, readMedium(), {} };
    for (const EffectParameter& parameter : form.parameters)
    {
      append(parameter, effect.parameters);
    }
    return effect;
  }

private:
  [[noreturn]] void fail(
    const std::string& what, const std::string& expected, const std::string& remedy) const
  {
    const std::string name = Name.empty() ? "" : " (" + Name + ")";
    throw FormatError(Reader.placeOfKey("effect", Index),
      "effect " + std::to_string(Index + 1) + name + ": " + what, expected, remedy);
  }

  void requireKeys() const
  {
    static constexpr std::array<std::string_view, 5> Known = { "effect", "form", "parameters",
      "channel", "medium" };
    if (!Entry.is_object())
    {
      fail(std::string("holds ") + Entry.type_name(), "an object with effect and parameters",
        "correct the entry");
    }
    for (const auto& [key, value] : Entry.items())
    {
      if (std::find(Known.begin(), Known.end(), key) == Known.end())
      {
        fail("has the unknown key '" + key + "'", "effect, form, parameters, channel and medium",
          "remove the key");
      }
    }
  }

  std::optional<std::string> text(const char* key) const
  {
    const Json* value = JsonText::find(Entry, key);
    if (value == nullptr)
    {
      return std::nullopt;
    }
    if (!value->is_string())
    {
      fail(std::string("'") + key + "' holds " + value->type_name(), "a text", "correct the value");
    }
    return value->get<std::string>();
  }

  void readChannel()
  {
    const auto name = text("channel");
    if (!name)
    {
      return;
    }
    const auto found = std::find(Channels.begin(), Channels.end(), *name);
    if (found == Channels.end())
    {
      std::string known;
      for (const std::string& channel : Channels)
      {
        known += (known.empty() ? "" : ", ") + channel;
      }
      fail("the camera has no channel '" + *name + "'", "one of " + known, "correct the name");
    }
    Channel = static_cast<std::size_t>(found - Channels.begin());
  }

  // Parameters as versions before 'along_x' called them, though y points up where an image is shown.
  void renameFormer()
  {
    for (const auto& [former, now] :
      { std::pair("right", "along_x"), std::pair("down", "along_y") })
    {
      if (const auto found = Parameters.find(former);
          found != Parameters.end() && !Parameters.contains(now))
      {
        Json value = std::move(*found);
        Parameters.erase(found);
        Parameters.emplace(now, std::move(value));
      }
    }
  }

  std::string readMedium() const
  {
    std::string medium = text("medium").value_or("");
    const bool needed = Definition->need == EffectNeed::Medium;
    if (needed && medium.empty())
    {
      fail("has no medium", "the name of the medium that it acts on", "add the key 'medium'");
    }
    if (!needed && !medium.empty())
    {
      fail("has the medium '" + medium + "'", "no medium: this effect acts on all of them",
        "remove the key 'medium'");
    }
    return medium;
  }

  // Whether the form has every parameter given, per channel where that is asked for.
  bool fits(const EffectForm& form) const
  {
    bool perChannel = false;
    for (const auto& [name, value] : Parameters.items())
    {
      const EffectParameter* parameter = findParameter(form, name);
      if (parameter == nullptr || (value.is_array() && !parameter->perChannel))
      {
        return false;
      }
      perChannel = perChannel || parameter->perChannel;
    }
    return !Channel || perChannel;
  }

  const EffectForm& chooseForm() const
  {
    if (const auto name = text("form"))
    {
      const EffectForm* form = findForm(*Definition, *name);
      if (form == nullptr)
      {
        fail("it has no form '" + *name + "'", "one of " + namesOf(Definition->forms),
          "correct the form");
      }
      requireFit(*form);
      return *form;
    }
    const auto found = std::find_if(Definition->forms.begin(), Definition->forms.end(),
      [this](const EffectForm& form) { return fits(form); });
    if (found == Definition->forms.end())
    {
      requireFit(Definition->forms.front());
      fail("no form of it has all these parameters", "one of " + namesOf(Definition->forms),
        "name the form");
    }
    return *found;
  }

  void requireFit(const EffectForm& form) const
  {
    for (const auto& [name, value] : Parameters.items())
    {
      const EffectParameter* parameter = findParameter(form, name);
      if (parameter == nullptr)
      {
        fail("the form " + form.name + " has no parameter '" + name + "'",
          "one of " + namesOf(form.parameters), "correct the name");
      }
      if (value.is_array() && !parameter->perChannel)
      {
        fail("parameter '" + name + "' holds a list", "one number", "correct the value");
      }
    }
    if (Channel && !fits(form))
    {
      fail("has a channel, but the form " + form.name + " treats all channels alike",
        "a form that is per channel, of " + namesOf(Definition->forms), "remove the key 'channel'");
    }
  }

  double checked(const EffectParameter& parameter, const Json& value) const
  {
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= parameter.lower && number <= parameter.upper))
    {
      fail("parameter '" + parameter.name + "' is " +
          value.dump(-1, ' ', false, Json::error_handler_t::replace),
        "a number from " + numberText(parameter.lower) + " to " + numberText(parameter.upper) +
          (parameter.unit == "1" ? "" : " (" + parameter.unit + ")"),
        "correct the value");
    }
    return number;
  }

  void append(const EffectParameter& parameter, std::vector<double>& values) const
  {
    const std::size_t count = parameter.perChannel ? Channels.size() : 1;
    const auto found = Parameters.find(parameter.name);
    if (found == Parameters.end())
    {
      values.insert(values.end(), count, parameter.neutral);
      return;
    }
    if (!found->is_array())
    {
      const double value = checked(parameter, *found);
      const std::size_t first = values.size();
      const bool one = parameter.perChannel && Channel;
      values.insert(values.end(), count, one ? parameter.neutral : value);
      values[one ? first + *Channel : first] = value;
      return;
    }
    if (found->size() != count)
    {
      fail("parameter '" + parameter.name + "' has " + std::to_string(found->size()) + " values",
        std::to_string(count) + ", as the camera has channels", "correct the list");
    }
    std::transform(found->begin(), found->end(), std::back_inserter(values),
      [&](const Json& value) { return checked(parameter, value); });
  }

  const JsonText& Reader;
  const Json& Entry;
  std::size_t Index;
  const std::vector<std::string>& Channels;
  std::string Name;
  const EffectDefinition* Definition = nullptr;
  Json Parameters;
  std::optional<std::size_t> Channel;
};
}

std::vector<CameraEffect> parseEffectList(
  const std::string& file, const std::string& text, const std::vector<std::string>& channels)
{
  const JsonText reader(file, text);
  const Json json = reader.parse();
  const Json* list = json.is_object() ? JsonText::find(json, "effects") : &json;
  if (list == nullptr || !list->is_array())
  {
    throw FormatError(file,
      std::string(json.is_object() ? "'effects' holds " : "holds ") +
        (list == nullptr ? "nothing" : list->type_name()),
      "a list of effects, [{\"effect\": ..., \"parameters\": {...}}, ...]", "see Formats.md");
  }
  std::vector<CameraEffect> effects;
  for (const Json& entry : *list)
  {
    effects.push_back(EffectReader(reader, entry, effects.size(), channels).read());
  }
  return effects;
}

std::vector<CameraEffect> readEffectList(
  const std::string& path, const std::vector<std::string>& channels)
{
  return parseEffectList(path, readTextFile(path, "a list of effects (JSON)"), channels);
}

std::string effectListText(
  const std::vector<CameraEffect>& effects, const std::vector<std::string>& channels)
{
  auto list = nlohmann::ordered_json::array();
  for (const CameraEffect& effect : effects)
  {
    const std::size_t count = effectParameters(effect, channels).size();
    const EffectForm& form = *findForm(*findEffect(effect.name), effect.form);
    if (effect.parameters.size() != count)
    {
      throw std::invalid_argument("the camera effect " + effect.name + " in the form " + form.name +
        " has " + std::to_string(count) + " parameters but " +
        std::to_string(effect.parameters.size()) + " are given");
    }
    nlohmann::ordered_json entry;
    entry["effect"] = effect.name;
    entry["form"] = form.name;
    auto parameters = nlohmann::ordered_json::object();
    auto at = effect.parameters.begin();
    for (const EffectParameter& parameter : form.parameters)
    {
      if (parameter.perChannel)
      {
        const auto end = at + static_cast<std::ptrdiff_t>(channels.size());
        parameters[parameter.name] = std::vector<double>(at, end);
        at = end;
      }
      else
      {
        parameters[parameter.name] = *at++;
      }
    }
    entry["parameters"] = std::move(parameters);
    if (!effect.medium.empty())
    {
      entry["medium"] = effect.medium;
    }
    list.push_back(std::move(entry));
  }
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace msi

#include "Formats/Capture.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Text/TextPlace.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace msi
{

namespace
{
using Json = nlohmann::json;

class DescriptionReader
{
public:
  DescriptionReader(std::string file, std::string text)
    : File(std::move(file))
    , Text(std::move(text))
  {
  }

  CaptureDescription read()
  {
    const Json json = parse();
    if (!json.is_object())
    {
      throw FormatError(File, std::string("holds ") + json.type_name(),
        "an object with name, white_level, dark and noise", "see Formats.md");
    }
    CaptureDescription capture;
    if (const Json* name = find(json, "name"))
    {
      requireType(name->is_string(), "name", "a text");
      capture.name = name->get<std::string>();
    }
    capture.whiteLevel = number(json, "white_level");
    if (capture.whiteLevel && *capture.whiteLevel <= 0.0)
    {
      refuse("white_level", "a number above 0");
    }
    capture.dark = dark(json);
    if (const Json* noise = find(json, "noise"))
    {
      requireType(noise->is_object(), "noise", "an object with read and shot, or null");
      capture.noise = { deviation(*noise, "read"), deviation(*noise, "shot") };
    }
    noteUnknownKeys(json, capture);
    return capture;
  }

private:
  Json parse() const
  {
    try
    {
      return Json::parse(Text);
    }
    catch (const Json::parse_error& error)
    {
      const bool atEnd = error.byte > Text.find_last_not_of(" \t\r\n") + 1;
      throw FormatError(placeOfOffset(File, Text, error.byte > 0 ? error.byte - 1 : 0),
        atEnd ? "the JSON text ends too early" : "this is no JSON", "a JSON object",
        atEnd ? "the file seems to be cut off" : "correct this line");
    }
  }

  // The value of a key; null where it is missing or null.
  static const Json* find(const Json& object, const char* key)
  {
    const auto found = object.find(key);
    return found == object.end() || found->is_null() ? nullptr : &*found;
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const
  {
    const std::size_t at = Text.find('"' + key + '"');
    throw FormatError(
      at == std::string::npos ? FilePlace{ File, 0, 0 } : placeOfOffset(File, Text, at),
      "'" + key + "' has a value that cannot be used", expected, "correct the value");
  }

  void requireType(bool fits, const std::string& key, const std::string& expected) const
  {
    if (!fits)
    {
      refuse(key, expected);
    }
  }

  std::optional<double> number(const Json& object, const char* key) const
  {
    const Json* value = find(object, key);
    if (value == nullptr)
    {
      return std::nullopt;
    }
    requireType(value->is_number(), key, "a number or null");
    return value->get<double>();
  }

  std::optional<double> deviation(const Json& object, const char* key) const
  {
    const auto value = number(object, key);
    requireType(!value || *value >= 0.0, key, "a number from 0 up, or null");
    return value;
  }

  std::vector<double> dark(const Json& json) const
  {
    const Json* value = find(json, "dark");
    if (value == nullptr)
    {
      return {};
    }
    const char* const expected = "a number or a list with one number per channel";
    if (value->is_number())
    {
      return { value->get<double>() };
    }
    requireType(value->is_array() && !value->empty() &&
        std::all_of(
          value->begin(), value->end(), [](const Json& item) { return item.is_number(); }),
      "dark", expected);
    return value->get<std::vector<double>>();
  }

  static void noteUnknownKeys(const Json& json, CaptureDescription& capture)
  {
    for (const auto& [key, value] : json.items())
    {
      if (key != "name" && key != "white_level" && key != "dark" && key != "noise")
      {
        capture.notes.push_back("capture.json: key '" + key + "' was left unread");
      }
    }
  }

  std::string File;
  std::string Text;
};
}

CaptureDescription parseCaptureDescription(const std::string& file, const std::string& text)
{
  return DescriptionReader(file, text).read();
}

CaptureDescription readCaptureDescription(const std::string& path)
{
  return parseCaptureDescription(path, readTextFile(path, "a capture description (JSON)"));
}

} // namespace msi

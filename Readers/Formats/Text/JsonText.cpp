#include "Formats/Text/JsonText.h"

#include "Formats/Text/TextPlace.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace msi
{

JsonText::JsonText(std::string file, std::string text)
  : File(std::move(file))
  , Text(std::move(text))
{
}

JsonText::Json JsonText::parse() const
{
  // The keys of every object that is open; a key that stands twice would be lost without a word.
  std::vector<std::set<std::string>> open;
  std::map<std::string, std::size_t> seen; // how often each key came so far
  const auto onEvent = [&](int, Json::parse_event_t event, Json& parsed)
  {
    if (event == Json::parse_event_t::object_start)
    {
      open.emplace_back();
    }
    else if (event == Json::parse_event_t::object_end)
    {
      open.pop_back();
    }
    else if (event == Json::parse_event_t::key)
    {
      const auto key = parsed.get<std::string>();
      const std::size_t nth = seen[key]++;
      if (!open.back().insert(key).second)
      {
        throw FormatError(placeOfKey(key, nth), "the key '" + key + "' stands twice in one object",
          "every key once", "remove one of them");
      }
    }
    return true;
  };
  try
  {
    return Json::parse(Text, onEvent);
  }
  catch (const Json::parse_error& error)
  {
    const bool atEnd = error.byte > Text.find_last_not_of(" \t\r\n") + 1;
    throw FormatError(placeOfOffset(File, Text, error.byte > 0 ? error.byte - 1 : 0),
      atEnd ? "the JSON text ends too early" : "this is no JSON", "a JSON object",
      atEnd ? "the file seems to be cut off" : "correct this line");
  }
  catch (const Json::out_of_range& error)
  {
    // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
    const std::string what = error.what();
    const std::size_t quote = what.find('\'');
    const std::size_t end = what.rfind('\'');
    const std::string number =
      quote < end ? what.substr(quote + 1, end - quote - 1) : std::string();
    const std::size_t at = number.empty() ? std::string::npos : Text.find(number);
    throw FormatError(
      at == std::string::npos ? FilePlace{ File, 0, 0 } : placeOfOffset(File, Text, at),
      "the number " + number + " is too large", "a number below 1.8e308", "correct the number");
  }
}

FilePlace JsonText::placeOfKey(const std::string& key, std::size_t nth) const
{
  const std::string quoted = '"' + key + '"';
  for (auto at = Text.find(quoted); at != std::string::npos; at = Text.find(quoted, at + 1))
  {
    const auto next = Text.find_first_not_of(" \t\r\n", at + quoted.size());
    const bool isKey = next != std::string::npos && Text[next] == ':';
    if (isKey && nth-- == 0)
    {
      return placeOfOffset(File, Text, at);
    }
  }
  return { File, 0, 0 };
}

const JsonText::Json* JsonText::find(const Json& object, const char* key)
{
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

std::optional<std::string> JsonText::text(const Json& object, const char* key) const
{
  const Json* value = find(object, key);
  if (value == nullptr)
  {
    return std::nullopt;
  }
  requireType(value->is_string(), key, "a text");
  return value->get<std::string>();
}

std::optional<double> JsonText::number(const Json& object, const char* key) const
{
  const Json* value = find(object, key);
  if (value == nullptr)
  {
    return std::nullopt;
  }
  requireType(value->is_number(), key, "a number or null");
  return value->get<double>();
}

std::optional<double> JsonText::numberFromZero(const Json& object, const char* key) const
{
  const auto value = number(object, key);
  requireType(!value || *value >= 0.0, key, "a number from 0 up, or null");
  return value;
}

std::optional<double> JsonText::deviation(const Json& object, const char* key) const
{
  constexpr double Largest = 0.5;
  const auto value = numberFromZero(object, key);
  requireType(!value || *value <= Largest, key,
    "a standard deviation relative to white, up to 0.5 (counts over the white level), or null");
  return value;
}

std::optional<bool> JsonText::truth(const Json& object, const char* key) const
{
  const Json* value = find(object, key);
  if (value == nullptr)
  {
    return std::nullopt;
  }
  requireType(value->is_boolean(), key, "true or false");
  return value->get<bool>();
}

std::vector<double> JsonText::channelNumbers(const Json& object, const char* key) const
{
  const Json* value = find(object, key);
  if (value == nullptr)
  {
    return {};
  }
  if (value->is_number())
  {
    return { value->get<double>() };
  }
  requireType(value->is_array() && !value->empty() &&
      std::all_of(value->begin(), value->end(), [](const Json& item) { return item.is_number(); }),
    key, "a number or a list with one number per channel");
  return value->get<std::vector<double>>();
}

void JsonText::refuse(const std::string& key, const std::string& expected) const
{
  throw FormatError(placeOfKey(key), "'" + key + "' has a value that cannot be used", expected,
    "correct the value");
}

void JsonText::requireType(bool fits, const std::string& key, const std::string& expected) const
{
  if (!fits)
  {
    refuse(key, expected);
  }
}

} // namespace msi

#include "Formats/Images/EnviHeaderText.h"

#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <utility>

namespace msi
{

namespace
{
std::string_view lineAt(std::string_view text, std::size_t at)
{
  const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
  return text.substr(at, end - at);
}

// Past the line end, which is \n, \r\n or \r.
std::size_t nextLine(std::string_view text, std::size_t at)
{
  const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
  return end + (text.substr(end, 2) == "\r\n" ? 2 : (end < text.size() ? 1 : 0));
}

std::string normalizedKey(std::string_view key)
{
  std::string normalized;
  for (const char c : lowerCase(trimmed(key)))
  {
    const bool blank = c == ' ' || c == '\t' || c == '_';
    if (!blank)
    {
      normalized += c;
    }
    else if (!normalized.empty() && normalized.back() != ' ')
    {
      normalized += ' ';
    }
  }
  return normalized;
}

std::optional<std::int64_t> wholeNumber(std::string_view text)
{
  text = trimmed(text);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && !text.empty() && end == text.data() + text.size()
    ? std::optional(value)
    : std::nullopt;
}

std::string shortened(const std::string& text)
{
  constexpr std::size_t longest = 40;
  return "'" + text.substr(0, longest) + (text.size() > longest ? "...'" : "'");
}
}

EnviHeaderText::EnviHeaderText(const std::string& file, const std::string& text)
  : File(file)
{
  const std::string first(trimmed(lineAt(text, 0)));
  if (lowerCase(first) != "envi")
  {
    throw FormatError(FilePlace{ file, 1, 1 }, "the first line is " + shortened(first), "ENVI",
      "name an ENVI header or its data file");
  }
  for (std::size_t at = nextLine(text, 0); at < text.size();)
  {
    ++Line;
    takeLine(text, at);
  }
}

void EnviHeaderText::takeLine(const std::string& text, std::size_t& at)
{
  const std::string_view line = lineAt(text, at);
  const std::string_view content = trimmed(line);
  const std::size_t equals = line.find('=');
  if (content.empty() || content.front() == ';' || equals == std::string_view::npos ||
    trimmed(line.substr(0, equals)).empty())
  {
    if (!content.empty() && content.front() != ';')
    {
      Notes.push_back(
        "line " + std::to_string(Line) + " was not understood: " + shortened(std::string(content)));
    }
    at = nextLine(text, at);
    return;
  }
  const auto column = static_cast<std::int64_t>(content.data() - line.data()) + 1;
  EnviValue value;
  value.text = trimmed(line.substr(equals + 1));
  value.place = { File, Line, column };
  const std::string key = normalizedKey(line.substr(0, equals));
  at = nextLine(text, at);
  if (value.text.empty() && trimmed(lineAt(text, at)).substr(0, 1) == "{")
  {
    value.text = trimmed(lineAt(text, at));
    at = nextLine(text, at);
    ++Line;
  }
  if (!value.text.empty() && value.text.front() == '{')
  {
    bool closed = value.text.find('}') != std::string::npos;
    while (!closed)
    {
      if (at >= text.size())
      {
        throw FormatError(value.place, "the value of '" + key + "' has no end", "a closing brace",
          "the header seems to be cut off");
      }
      const std::string_view more = trimmed(lineAt(text, at));
      if (more.empty() || more.front() != ';')
      {
        value.text += ' ';
        value.text += more;
        closed = more.find('}') != std::string_view::npos;
      }
      at = nextLine(text, at);
      ++Line;
    }
    const std::size_t end = value.text.find('}');
    value.text = std::string(trimmed(std::string_view(value.text).substr(1, end - 1)));
  }
  add(key, std::move(value));
}

void EnviHeaderText::add(const std::string& key, EnviValue value)
{
  const auto [found, added] = Values.emplace(key, value);
  if (!added && found->second.text != value.text)
  {
    found->second.otherPlace = value.place;
  }
}

std::optional<std::string> EnviHeaderText::find(const std::string& key)
{
  const auto found = Values.find(key);
  if (found == Values.end())
  {
    return std::nullopt;
  }
  EnviValue& value = found->second;
  value.used = true;
  if (value.otherPlace)
  {
    throw FormatError(*value.otherPlace,
      "'" + key + "' stands here a second time with another value",
      "the value of line " + std::to_string(value.place.line) + ", " + shortened(value.text),
      "remove one of the lines");
  }
  return value.text;
}

std::string EnviHeaderText::require(const std::string& key)
{
  if (auto value = find(key))
  {
    return *value;
  }
  throw FormatError(
    File, "the key '" + key + "' is missing", "'" + key + " = ...'", "add it to the header");
}

void EnviHeaderText::refuse(const std::string& key, const std::string& what,
  const std::string& expected, const std::string& remedy) const
{
  const auto found = Values.find(key);
  throw FormatError(found == Values.end() ? FilePlace{ File, 0, 0 } : found->second.place,
    "'" + key + "' " + what, expected, remedy);
}

std::optional<std::int64_t> EnviHeaderText::findInteger(const std::string& key, std::int64_t least)
{
  const auto text = find(key);
  if (!text)
  {
    return std::nullopt;
  }
  const auto value = wholeNumber(*text);
  if (!value || *value < least)
  {
    refuse(key, "is " + shortened(*text), "a whole number from " + std::to_string(least) + " up");
  }
  return value;
}

std::int64_t EnviHeaderText::requireInteger(const std::string& key, std::int64_t least)
{
  require(key);
  return *findInteger(key, least);
}

std::optional<double> EnviHeaderText::findNumber(const std::string& key)
{
  const auto text = find(key);
  if (!text)
  {
    return std::nullopt;
  }
  const auto value = parseNumber(*text);
  if (!value)
  {
    refuse(key, "is " + shortened(*text), "a number");
  }
  return value;
}

std::optional<std::vector<std::string>> EnviHeaderText::findList(const std::string& key)
{
  const auto text = find(key);
  if (!text)
  {
    return std::nullopt;
  }
  std::vector<std::string> items;
  for (std::size_t at = 0; at <= text->size() && !text->empty();)
  {
    const std::size_t end = std::min(text->find(',', at), text->size());
    items.emplace_back(trimmed(std::string_view(*text).substr(at, end - at)));
    at = end + 1;
  }
  if (!items.empty() && items.back().empty())
  {
    items.pop_back(); // a comma after the last one
  }
  return items;
}

std::optional<std::vector<double>> EnviHeaderText::findNumbers(
  const std::string& key, std::int64_t count, const std::string& each)
{
  const auto items = findList(key);
  if (!items)
  {
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (const std::string& item : *items)
  {
    const auto value = parseNumber(item);
    if (!value)
    {
      refuse(key, "holds " + shortened(item), "numbers with commas between them");
    }
    numbers.push_back(*value);
  }
  if (static_cast<std::int64_t>(numbers.size()) != count)
  {
    refuse(key, "has " + std::to_string(numbers.size()) + " values",
      std::to_string(count) + ", " + each, "complete the list or remove the key");
  }
  return numbers;
}

std::map<std::string, std::string> EnviHeaderText::unusedKeys() const
{
  std::map<std::string, std::string> keys;
  for (const auto& [key, value] : Values)
  {
    if (!value.used)
    {
      keys.emplace(key, value.text);
    }
  }
  return keys;
}

} // namespace msi

#include "Formats/Text/TextEncoding.h"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <vector>

#include <utf8.h>

namespace msi
{

namespace
{
bool startsWith(std::string_view text, std::string_view beginning)
{
  return text.substr(0, beginning.size()) == beginning;
}

std::optional<std::string> fromUtf16(std::string_view text, bool bigEndian)
{
  if (text.size() % 2 != 0)
  {
    return std::nullopt;
  }
  std::vector<std::uint16_t> words;
  words.reserve(text.size() / 2);
  for (std::size_t at = 0; at < text.size(); at += 2)
  {
    const auto first = static_cast<unsigned char>(text[at]);
    const auto second = static_cast<unsigned char>(text[at + 1]);
    words.push_back(
      static_cast<std::uint16_t>(bigEndian ? first << 8U | second : second << 8U | first));
  }
  std::string converted;
  try
  {
    utf8::utf16to8(words.begin(), words.end(), std::back_inserter(converted));
  }
  catch (const utf8::exception&)
  {
    return std::nullopt;
  }
  return converted;
}

std::string fromLatin1(std::string_view text)
{
  std::string converted;
  for (const char c : text)
  {
    utf8::append(static_cast<unsigned char>(c), std::back_inserter(converted));
  }
  return converted;
}
}

std::optional<std::string> asUtf8(std::string text)
{
  using namespace std::string_view_literals;
  if (startsWith(text, "\xFF\xFE"sv) || startsWith(text, "\xFE\xFF"sv))
  {
    return fromUtf16(std::string_view(text).substr(2), text.front() == '\xFE');
  }
  if (startsWith(text, "\xEF\xBB\xBF"sv))
  {
    text.erase(0, 3);
  }
  return utf8::is_valid(text.begin(), text.end()) ? text : fromLatin1(text);
}

} // namespace msi

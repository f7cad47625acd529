#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace msi
{

namespace
{
constexpr std::string_view Blanks = " \t\r\n\v\f";
constexpr std::size_t LongestNumber = 400; // every double has fewer than 400 characters in "%f"

template <typename T>
std::string shortest(T value)
{
  std::array<char, 64> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return error == std::errc() ? std::string(buffer.data(), end) : std::string();
}
}

std::string_view trimmed(std::string_view text) noexcept
{
  const auto first = text.find_first_not_of(Blanks);
  if (first == std::string_view::npos)
  {
    return {};
  }
  return text.substr(first, text.find_last_not_of(Blanks) - first + 1);
}

std::string lowerCase(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

std::optional<double> parseNumber(std::string_view text, bool decimalComma) noexcept
{
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-')
  {
    text.remove_prefix(1);
  }
  std::array<char, LongestNumber> point{};
  if (decimalComma && text.size() < point.size() && text.find(',') != std::string_view::npos &&
    text.find('.') == std::string_view::npos)
  {
    std::replace_copy(text.begin(), text.end(), point.begin(), ',', '.');
    text = std::string_view(point.data(), text.size());
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || text.empty() || end != text.data() + text.size())
  {
    return std::nullopt;
  }
  return value;
}

std::optional<int> parseInteger(std::string_view text) noexcept
{
  text = trimmed(text);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || text.empty() || end != text.data() + text.size())
  {
    return std::nullopt;
  }
  return value;
}

std::string numberText(double value)
{
  return shortest(value);
}

std::string numberText(float value)
{
  return shortest(value);
}

} // namespace msi

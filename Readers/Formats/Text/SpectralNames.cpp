#include "Formats/Text/SpectralNames.h"

#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>

namespace msi
{

namespace
{
constexpr double ShortestWavelength = 100.0;
constexpr double LongestWavelength = 20000.0;
constexpr double SmallestResponseWavelength = 200.0;
constexpr double LongestFileNameWavelength = 2500.0;

bool isDigit(char c) noexcept
{
  return c >= '0' && c <= '9';
}

bool isLetter(char c) noexcept
{
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// PREFIX[_- ]NUMBER[_- ][nm] for one of the prefixes; the number or the unit may stand in brackets.
template <std::size_t N>
std::optional<double> numberAfter(
  const std::array<std::string_view, N>& prefixes, std::string_view name, bool decimalComma)
{
  const std::string lower = lowerCase(trimmed(name));
  const auto digit = std::find_if(lower.begin(), lower.end(), isDigit);
  if (digit == lower.end())
  {
    return std::nullopt;
  }
  const auto split = static_cast<std::size_t>(digit - lower.begin());
  const std::string_view separators = "_- ([";
  std::string_view prefix = std::string_view(lower).substr(0, split);
  while (!prefix.empty() && separators.find(prefix.back()) != std::string_view::npos)
  {
    prefix.remove_suffix(1);
  }
  if (std::find(prefixes.begin(), prefixes.end(), prefix) == prefixes.end())
  {
    return std::nullopt;
  }
  std::string_view number = std::string_view(lower).substr(split);
  if (number.back() == ')' || number.back() == ']')
  {
    number.remove_suffix(1);
  }
  if (number.size() > 2 && number.substr(number.size() - 2) == "nm")
  {
    number.remove_suffix(2);
    while (!number.empty() && separators.find(number.back()) != std::string_view::npos)
    {
      number.remove_suffix(1);
    }
  }
  if (number.find_first_not_of("0123456789.,") != std::string_view::npos)
  {
    return std::nullopt;
  }
  return parseNumber(number, decimalComma);
}

struct NumberInText
{
  double value;
  bool unit;        // "nm" follows, perhaps after a blank, _ or -
  bool letterAfter; // another letter follows at once
  std::size_t begin;
  std::size_t end;
};

std::vector<NumberInText> numbersIn(std::string_view text, bool decimalComma = false)
{
  const std::string lower = lowerCase(text);
  std::vector<NumberInText> numbers;
  for (std::size_t begin = 0; begin < lower.size();)
  {
    if (!isDigit(lower[begin]))
    {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    bool fraction = false;
    while (end < lower.size() &&
      (isDigit(lower[end]) ||
        (!fraction && (lower[end] == '.' || (decimalComma && lower[end] == ',')) &&
          end + 1 < lower.size() && isDigit(lower[end + 1]))))
    {
      fraction = fraction || !isDigit(lower[end]);
      ++end;
    }
    const std::size_t unit = std::min(lower.find_first_not_of("_- ", end), lower.size());
    const bool hasUnit =
      lower.compare(unit, 2, "nm") == 0 && (unit + 2 == lower.size() || !isLetter(lower[unit + 2]));
    if (const auto value =
          parseNumber(std::string_view(lower).substr(begin, end - begin), decimalComma))
    {
      numbers.push_back(
        { *value, hasUnit, end < lower.size() && isLetter(lower[end]), begin, end });
    }
    begin = end;
  }
  return numbers;
}
}

std::optional<double> reflectanceColumnWavelength(std::string_view name, bool decimalComma)
{
  static constexpr std::array<std::string_view, 14> Prefixes = { "", "r", "x", "nm", "wl", "refl",
    "reflectance", "lambda", "spec", "spec_nm", "spectral", "spectral_nm", "wavelength", "w" };
  const auto nm = numberAfter(Prefixes, name, decimalComma);
  return nm && *nm >= ShortestWavelength && *nm <= LongestWavelength ? nm : std::nullopt;
}

std::optional<double> responseColumnNumber(std::string_view name, bool decimalComma)
{
  static constexpr std::array<std::string_view, 3> Prefixes = { "c", "ch", "channel" };
  return numberAfter(Prefixes, name, decimalComma);
}

bool areResponseWavelengths(const std::vector<double>& numbers) noexcept
{
  return !numbers.empty() &&
    std::all_of(numbers.begin(), numbers.end(),
      [](double number)
      { return number >= SmallestResponseWavelength && number <= LongestWavelength; });
}

std::vector<FileNameWavelength> fileNameWavelengths(const std::string& path)
{
  std::vector<FileNameWavelength> marked;
  std::vector<FileNameWavelength> alone;
  for (const NumberInText& found : numbersIn(std::filesystem::path(path).stem().string(), true))
  {
    if (found.unit && found.value >= ShortestWavelength && found.value <= LongestWavelength)
    {
      marked.push_back({ found.value, true, found.begin, found.end });
    }
    if (!found.letterAfter && found.value >= SmallestResponseWavelength &&
      found.value <= LongestFileNameWavelength)
    {
      alone.push_back({ found.value, false, found.begin, found.end });
    }
  }
  return marked.empty() ? alone : marked;
}

std::optional<double> wavelengthInText(std::string_view text)
{
  std::optional<double> only;
  for (const NumberInText& found : numbersIn(text))
  {
    if (found.unit && found.value >= ShortestWavelength && found.value <= LongestWavelength)
    {
      if (only && *only != found.value)
      {
        return std::nullopt;
      }
      only = found.value;
    }
  }
  return only;
}

double withoutConversionNoise(double nanometres) noexcept
{
  constexpr double perNanometre = 1e6;
  return std::round(nanometres * perNanometre) / perNanometre;
}

bool naturalLess(std::string_view a, std::string_view b) noexcept
{
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    if (isDigit(a[i]) && isDigit(b[j]))
    {
      const auto runOf = [](std::string_view text, std::size_t& at)
      {
        while (at < text.size() && text[at] == '0')
        {
          ++at;
        }
        const std::size_t first = at;
        while (at < text.size() && isDigit(text[at]))
        {
          ++at;
        }
        return text.substr(first, at - first);
      };
      const std::string_view runA = runOf(a, i);
      const std::string_view runB = runOf(b, j);
      if (runA.size() != runB.size())
      {
        return runA.size() < runB.size();
      }
      if (runA != runB)
      {
        return runA < runB;
      }
      continue;
    }
    if (a[i] != b[j])
    {
      return a[i] < b[j];
    }
    ++i;
    ++j;
  }
  if (a.size() - i != b.size() - j)
  {
    return a.size() - i < b.size() - j;
  }
  return a < b;
}

} // namespace msi

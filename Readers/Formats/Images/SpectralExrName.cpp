#include "Formats/Images/SpectralExrName.h"

#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace msi
{

namespace
{
constexpr double NanometresPerMetre = 1e9;
constexpr double Shortest = 1.0;
constexpr double Longest = 1e6;

// nm of NUMBER[PREFIX](m|Hz).
std::optional<double> nanometresOf(std::string_view text)
{
  static constexpr std::array<std::pair<std::string_view, double>, 17> Prefixes = { {
    { "da", 1e1 },
    { "Y", 1e24 },
    { "Z", 1e21 },
    { "E", 1e18 },
    { "P", 1e15 },
    { "T", 1e12 },
    { "G", 1e9 },
    { "M", 1e6 },
    { "k", 1e3 },
    { "h", 1e2 },
    { "d", 1e-1 },
    { "c", 1e-2 },
    { "m", 1e-3 },
    { "u", 1e-6 },
    { "n", 1e-9 },
    { "p", 1e-12 },
    { "", 1.0 },
  } };
  bool frequency = false;
  if (text.size() > 2 && text.substr(text.size() - 2) == "Hz")
  {
    frequency = true;
    text.remove_suffix(2);
  }
  else if (text.size() > 1 && text.back() == 'm')
  {
    text.remove_suffix(1);
  }
  else
  {
    return std::nullopt;
  }
  const std::size_t digits = text.find_last_of("0123456789,.") + 1;
  const auto prefix = std::find_if(Prefixes.begin(), Prefixes.end(),
    [unit = text.substr(digits)](const auto& entry) { return entry.first == unit; });
  const auto number = parseNumber(text.substr(0, digits), true);
  if (prefix == Prefixes.end() || !number || !(*number > 0.0))
  {
    return std::nullopt;
  }
  // 400 nm exactly, not 400 times 1e-9 times 1e9.
  const bool plain = prefix->first == "n" && !frequency;
  const double unit = *number * prefix->second;
  const double nm = plain
    ? *number
    : withoutConversionNoise((frequency ? SpeedOfLight / unit : unit) * NanometresPerMetre);
  return nm >= Shortest && nm <= Longest ? std::optional(nm) : std::nullopt;
}
}

std::optional<SpectralExrName> parseSpectralExrName(std::string_view name)
{
  SpectralExrName parsed{ 'T', 0, 0.0, false };
  if (name.substr(0, 2) == "T.")
  {
    name.remove_prefix(2);
  }
  else if (name.size() > 3 && name[0] == 'S' && name[1] >= '0' && name[1] <= '3' && name[2] == '.')
  {
    parsed.kind = 'S';
    parsed.stokes = name[1] - '0';
    name.remove_prefix(3);
  }
  else
  {
    return std::nullopt;
  }
  std::optional<double> nm = nanometresOf(name);
  for (std::size_t dot = name.find('.'); !nm && dot != std::string_view::npos;
       dot = name.find('.', dot + 1))
  {
    nm = nanometresOf(name.substr(0, dot));
    parsed.reradiating = nm && nanometresOf(name.substr(dot + 1));
    nm = parsed.reradiating ? nm : std::nullopt;
  }
  if (!nm)
  {
    return std::nullopt;
  }
  parsed.nanometres = *nm;
  return parsed;
}

std::string spectralExrName(char kind, double nanometres)
{
  std::string number = numberText(nanometres);
  std::replace(number.begin(), number.end(), '.', ',');
  return (kind == 'S' ? "S0." : "T.") + number + "nm";
}

} // namespace msi

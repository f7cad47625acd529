#include "Formats/Images/EnviWavelengths.h"

#include "Formats/Images/SpectralExrName.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
// nm = value x factor, or factor / value where the unit is one of frequency.
struct SpectralUnit
{
  std::string_view name;
  double factor;
  bool reciprocal;
};
constexpr double NanometresPerCentimetre = 1e7;
constexpr std::array<SpectralUnit, 26> SpectralUnits = { {
  { "nanometers", 1.0, false },
  { "nanometer", 1.0, false },
  { "nanometres", 1.0, false },
  { "nm", 1.0, false },
  { "micrometers", 1e3, false },
  { "micrometer", 1e3, false },
  { "micrometres", 1e3, false },
  { "microns", 1e3, false },
  { "micron", 1e3, false },
  { "um", 1e3, false },
  { "\xC2\xB5m", 1e3, false }, // the micro sign
  { "\xCE\xBCm", 1e3, false }, // the Greek mu
  { "millimeters", 1e6, false },
  { "mm", 1e6, false },
  { "centimeters", NanometresPerCentimetre, false },
  { "cm", NanometresPerCentimetre, false },
  { "meters", 1e9, false },
  { "m", 1e9, false },
  { "angstroms", 0.1, false },
  { "angstrom", 0.1, false },
  { "wavenumber", NanometresPerCentimetre, true },
  { "wavenumbers", NanometresPerCentimetre, true },
  { "cm-1", NanometresPerCentimetre, true },
  { "thz", SpeedOfLight / 1e3, true },
  { "ghz", SpeedOfLight, true },
  { "mhz", SpeedOfLight * 1e3, true },
} };
constexpr SpectralUnit Nanometres = SpectralUnits.front();
constexpr SpectralUnit Micrometres = { "micrometers", 1e3, false };
constexpr double ShortestNanometres = 100.0;

class WavelengthReader
{
public:
  WavelengthReader(EnviHeaderText& header, SpectralImageInfo& info)
    : Header(header)
    , Info(info)
  {
  }

  void read()
  {
    const int bands = Info.bands();
    auto stored = Header.findNumbers("wavelength", bands);
    auto widths = Header.findNumbers("fwhm", bands);
    const std::string unit = lowerCase(Header.find("wavelength units").value_or(""));
    if (!stored)
    {
      takeBandNames();
      return;
    }
    if (!arePossible(*stored, *stored))
    {
      return;
    }
    const auto found = unitOf(unit, *stored);
    if (!found)
    {
      return;
    }
    std::vector<double> wavelengths;
    for (std::size_t b = 0; b < stored->size(); ++b)
    {
      const double value = (*stored)[b];
      const double nm = found->reciprocal ? found->factor / value : value * found->factor;
      wavelengths.push_back(
        !found->reciprocal && found->factor == 1.0 ? nm : withoutConversionNoise(nm));
      if (widths)
      {
        // d(1/k) = dk / k^2
        (*widths)[b] *= found->reciprocal ? nm / value : found->factor;
      }
    }
    if (!arePossible(wavelengths, *stored)) // 1e60 per centimetre become 0 nm
    {
      return;
    }
    Info.wavelengths = std::move(wavelengths);
    if (widths)
    {
      Info.fwhm = std::move(*widths);
    }
  }

private:
  // Or a note on the first that is not, as it was stored.
  bool arePossible(const std::vector<double>& values, const std::vector<double>& stored)
  {
    const auto odd = std::find_if_not(values.begin(), values.end(),
      [](double value) { return value > 0.0 && value < std::numeric_limits<double>::infinity(); });
    if (odd == values.end())
    {
      return true;
    }
    const auto band = static_cast<std::size_t>(odd - values.begin());
    note("the wavelengths were forgotten: that of band " + std::to_string(band + 1) + " is " +
      numberText(stored[band]));
    return false;
  }

  void note(std::string text) { Info.notes.push_back(std::move(text)); }

  void takeBandNames()
  {
    std::vector<double> named;
    for (const std::string& name : Info.bandNames)
    {
      const auto nm = wavelengthInText(name);
      if (!nm)
      {
        return;
      }
      named.push_back(*nm);
    }
    Info.wavelengths = std::move(named);
    note("wavelengths are those in the names of the bands");
  }

  // Nothing where the numbers are no wavelengths.
  std::optional<SpectralUnit> unitOf(const std::string& unit, const std::vector<double>& stored)
  {
    const auto known = std::find_if(SpectralUnits.begin(), SpectralUnits.end(),
      [&unit](const SpectralUnit& entry) { return entry.name == unit; });
    if (known != SpectralUnits.end())
    {
      return *known;
    }
    const auto [least, most] = std::minmax_element(stored.begin(), stored.end());
    if (unit.empty() || unit == "unknown")
    {
      if (*least >= ShortestNanometres)
      {
        note("the header states no wavelength units: nanometres were assumed");
        return Nanometres;
      }
      const bool counts = std::all_of(
        stored.begin(), stored.end(), [](double value) { return value == std::floor(value); });
      if (*least >= 0.1 && *most < ShortestNanometres && !counts)
      {
        note("the header states no wavelength units: micrometres were assumed");
        return Micrometres;
      }
    }
    note("the wavelengths are unknown: their unit is " +
      (unit.empty() ? "not stated" : "'" + unit + "'"));
    return std::nullopt;
  }

  EnviHeaderText& Header;
  SpectralImageInfo& Info;
};
}

void readEnviWavelengths(EnviHeaderText& header, SpectralImageInfo& info)
{
  WavelengthReader(header, info).read();
}

} // namespace msi

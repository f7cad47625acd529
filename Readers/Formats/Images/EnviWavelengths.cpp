#include "Formats/Images/EnviWavelengths.h"

#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
struct LengthUnit
{
  std::string_view name;
  double nanometres;
};
constexpr std::array<LengthUnit, 17> LengthUnits = { {
  { "nanometers", 1.0 },
  { "nanometer", 1.0 },
  { "nanometres", 1.0 },
  { "nm", 1.0 },
  { "micrometers", 1e3 },
  { "micrometer", 1e3 },
  { "micrometres", 1e3 },
  { "microns", 1e3 },
  { "micron", 1e3 },
  { "um", 1e3 },
  { "\xC2\xB5m", 1e3 },
  { "millimeters", 1e6 },
  { "mm", 1e6 },
  { "centimeters", 1e7 },
  { "cm", 1e7 },
  { "angstroms", 0.1 },
  { "angstrom", 0.1 },
} };
constexpr double NanometresPerCentimetre = 1e7;
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
      return;
    }
    const bool wavenumber = unit == "wavenumber" || unit == "wavenumbers" || unit == "cm-1";
    const double scale = wavenumber ? 0.0 : nanometresPerUnit(unit, *stored);
    if (scale == 0.0 && !wavenumber)
    {
      return;
    }
    for (std::size_t b = 0; b < stored->size(); ++b)
    {
      const double value = (*stored)[b];
      requirePositive(b, value);
      const double nm = wavenumber ? NanometresPerCentimetre / value : value * scale;
      Info.wavelengths.push_back(scale == 1.0 ? nm : withoutConversionNoise(nm));
      if (widths)
      {
        // d(1/k) = dk / k^2
        (*widths)[b] *= wavenumber ? nm / value : scale;
      }
    }
    if (widths)
    {
      Info.fwhm = std::move(*widths);
    }
  }

private:
  void note(std::string text) { Info.notes.push_back(std::move(text)); }

  void requirePositive(std::size_t band, double value) const
  {
    if (!(value > 0.0 && value < std::numeric_limits<double>::infinity()))
    {
      Header.refuse("wavelength",
        "is " + numberText(value) + " for band " + std::to_string(band + 1), "a positive number");
    }
  }

  // 0 where the numbers are no wavelengths.
  double nanometresPerUnit(const std::string& unit, const std::vector<double>& stored)
  {
    const auto known = std::find_if(LengthUnits.begin(), LengthUnits.end(),
      [&unit](const LengthUnit& entry) { return entry.name == unit; });
    if (known != LengthUnits.end())
    {
      return known->nanometres;
    }
    const auto [least, most] = std::minmax_element(stored.begin(), stored.end());
    if (unit.empty() || unit == "unknown")
    {
      if (*least >= ShortestNanometres)
      {
        note("the header states no wavelength units: nanometres were assumed");
        return 1.0;
      }
      if (*least >= 0.1 && *most < ShortestNanometres && *least != std::floor(*least))
      {
        note("the header states no wavelength units: micrometres were assumed");
        return 1e3;
      }
    }
    note("the wavelengths are unknown: their unit is " +
      (unit.empty() ? "not stated" : "'" + unit + "'"));
    return 0.0;
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

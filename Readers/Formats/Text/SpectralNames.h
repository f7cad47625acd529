// What the names of columns, channels and files say about wavelengths.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

// nm of a reflectance column: R400, 400, 400nm, SPEC_400, SPECTRAL_NM400, SPECTRAL_NM_400, nm400,
// R_400.5, X400 (as R's read.csv writes it); nothing for any other name or outside 100..20000.
std::optional<double> reflectanceColumnWavelength(std::string_view name, bool decimalComma = false);

// The number of a response column: C1, C400, C_400, C400nm, ch1, channel_2.
std::optional<double> responseColumnNumber(std::string_view name, bool decimalComma = false);

// Whether the numbers of response columns are wavelengths: there is at least one, and each is 200 or more.
bool areResponseWavelengths(const std::vector<double>& numbers) noexcept;

struct FileNameWavelength
{
  double nanometres;
  bool hasUnit;      // "nm" follows the number; without it the number may be a frame number
  std::size_t begin; // of the number in the file's name (without folder)
  std::size_t end;   // behind its last digit
};

// nm in the name of an image file: the numbers followed by "nm" (channel_450nm.tif, 450,5nm.png); where there are none,
// the numbers from 200 to 2500 that stand alone (img_450.png, 450.tif).
std::vector<FileNameWavelength> fileNameWavelengths(const std::string& path);

// nm in a free text ("filter 450 nm"): the only number followed by "nm", else nothing.
std::optional<double> wavelengthInText(std::string_view text);

// A wavelength that was converted to nm, to 1e-6 nm: 0.57 um are 570 nm, not 569.9999999999999.
double withoutConversionNoise(double nanometres) noexcept;

// img2 before img10: runs of digits compare as numbers.
bool naturalLess(std::string_view a, std::string_view b) noexcept;

} // namespace msi

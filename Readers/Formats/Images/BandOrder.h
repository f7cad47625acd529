// Bands of one file by wavelength.
#pragma once

#include "Formats/SpectralImageFile.h"

#include <string>
#include <vector>

namespace msi
{

// Puts the wavelengths of the user into info, where there are any. Errors: FormatError naming 'file'
// and both numbers, or what is wrong with them.
void takeGivenWavelengths(
  SpectralImageInfo& info, const std::vector<double>& wavelengths, const std::string& file);

// Throws FormatError unless these, in any order, make a msi::WavelengthGrid.
void requireGrid(const std::vector<double>& wavelengths, const std::string& file);

// Sorts every list of info by wavelength. What is then no msi::WavelengthGrid, because two bands have
// the same wavelength or one lies outside of 100..20000 nm, is forgotten. Both are noted. Returns the
// band of the file for each band.
std::vector<int> sortByWavelength(SpectralImageInfo& info);

// Why these sorted wavelengths are no msi::WavelengthGrid, or an empty text.
std::string faultOfGrid(const std::vector<double>& sorted);

} // namespace msi

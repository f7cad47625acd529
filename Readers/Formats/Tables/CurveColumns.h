// From a table of text with one row a wavelength to curves.
#pragma once

#include "Formats/Curves.h"
#include "Formats/Text/TextTable.h"

#include <string_view>

namespace msi
{

// wavelength, wavelength_nm, "wavelength (nm)", nm, lambda, wl: the first column of a table of curves.
bool isWavelengthHeader(std::string_view name);

// With or without a header line. Errors: FormatError.
Curves curvesFromText(const TextTable& table);

} // namespace msi

// Curves over wavelength: filters, illuminants, observers, camera sensitivities.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// A table with one row a wavelength and one column a curve.
struct Curves
{
  WavelengthGrid wavelengths;
  std::vector<std::string> names; // C names
  Eigen::MatrixXd values;         // wavelengths x C
  std::vector<std::string> notes;
};

// Reads a table whose first column is the wavelength (named wavelength, nm, lambda or wl; upper and
// lower case alike; with or without a header line). Rows may come in any order; they are sorted.
// Errors: FormatError naming file, line and column.
Curves readCurves(const std::string& path);

// Writes the table; complete or absent; to the last bit.
void writeCurves(const std::string& path, const Curves& curves);

} // namespace msi

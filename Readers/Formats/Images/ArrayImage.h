// Spectral images in MAT and HDF5 files.
#pragma once

#include "Formats/Arrays/ArrayFile.h"
#include "Formats/SpectralImageFile.h"

#include <memory>
#include <string>
#include <vector>

namespace msi
{

// The array named in the options, else the only one with three axes longer than 1. Its spectral axis is
// the one as long as the wavelengths, where they are given or in the file; else the third of a MATLAB
// array, and the shortest of any other. Of the two others the first counts rows. A matrix of two axes
// is one band, where it is named.
// Errors: FormatError listing the arrays where none or several fit.
std::unique_ptr<SpectralImageFile> openArrayImage(
  std::unique_ptr<ArrayFile> file, const SpectralImageOptions& options);

// The arrays that the option may name, in the order of the file; empty for files of other kinds. Errors: FormatError for damaged files.
std::vector<std::string> imageVariables(const std::string& path);

} // namespace msi

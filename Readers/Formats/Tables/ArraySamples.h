// Sample tables in MAT and HDF5 files: matrices of reflectance and response.
#pragma once

#include "Formats/Arrays/ArrayFile.h"
#include "Formats/SampleTable.h"

namespace msi
{

// The reflectance is the matrix named in the options, else the only one with a side as long as the
// wavelengths; the responses the one named, else the only other matrix with a side as long as the
// samples. Wavelengths are those of the options, else of a vector in the file, else 400..700 nm in
// steps of 10. Text with a row for each sample names the samples.
// Errors: FormatError listing the matrices where none or several fit.
SampleTable samplesFromArrays(const ArrayFile& file, const SampleTableOptions& options);

} // namespace msi

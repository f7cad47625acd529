// ENVI spectral libraries as sample tables.
#pragma once

#include "Formats/SampleTable.h"

#include <optional>
#include <string>

namespace msi
{

// The table of a library, opened by its header or its data file (.sli); nothing where 'path' is no such file. One
// sample a spectrum, named by 'spectra names'. Errors: FormatError as of an ENVI image, and for a library without
// wavelengths or with values that are not finite.
std::optional<SampleTable> readEnviLibrary(const std::string& path, ReflectanceUnit unit);

} // namespace msi

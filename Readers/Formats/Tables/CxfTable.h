// CxF3, the color exchange format.
#pragma once

#include "Formats/SampleTable.h"

#include <string>
#include <string_view>

namespace msi
{

bool looksLikeXml(std::string_view text) noexcept;

// Every object with a reflectance spectrum is a sample, named by its Name, else its Id. Wavelengths are
// StartWL of the spectrum, else of its ColorSpecification, in steps of the Increment there. Of an object
// with several spectra (measurement conditions M0, M1, M2) the first is read, and that is noted.
// Source: ISO 17972-1 (2015).
// Errors: FormatError naming line and column.
SampleTable parseCxf(const std::string& file, const std::string& text, ReflectanceUnit unit);

} // namespace msi

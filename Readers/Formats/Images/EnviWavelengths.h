// The wavelengths of an ENVI header.
#pragma once

#include "Formats/Images/EnviHeaderText.h"
#include "Formats/SpectralImageFile.h"

namespace msi
{

// Reads "wavelength", "wavelength units" and "fwhm" into info, in nm and in the order of the file; notes
// which unit was assumed. Errors: FormatError naming line and key.
void readEnviWavelengths(EnviHeaderText& header, SpectralImageInfo& info);

} // namespace msi

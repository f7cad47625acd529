// A capture's folder as the diagnosis wants it.
#pragma once

#include "Formats/Capture.h"
#include "Kernels/Gap/SimToRealGap.h"

#include <string>

namespace withheld
{

// Throws msi::FormatError or std::invalid_argument.
msi::GapCapture readGapCapture(const std::string& folder);

} // namespace withheld

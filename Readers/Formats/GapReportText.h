// The diagnosis of a sim-to-real gap as report.json.
#pragma once

#include "Kernels/Gap/GapReport.h"

#include <string>

namespace msi
{

// JSON text, indented, with a line end. Keys as Documentation/Filters/SimToRealGap.md lists them; a number that is
// not finite is null. Where nothing needs to be told apart, next_capture holds an empty text and an empty list.
std::string gapReportText(const GapReport& report);

} // namespace msi

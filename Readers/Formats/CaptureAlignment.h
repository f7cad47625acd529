// Parts of a capture brought to one order of channels and one unit.
#pragma once

#include "Formats/Capture.h"

#include <string>

namespace msi
{

// Where camera.csv and responses.csv name the same channels in another order, the curves and dark values follow the
// responses; a note says so. Else channels belong together by their order.
void alignChannels(Capture& capture);

// Counts become responses, 1 = perfect white: a part (curves, dark values, responses) whose typical value lies above 2
// is divided by white_level, and dark values where the curves are; a note says so.
// Errors: FormatError where white_level is not given, or curves or responses are below 1 % or beyond 10 times of it: they are
// neither counts nor relative to white.
void alignUnits(Capture& capture, const std::string& folder);

} // namespace msi

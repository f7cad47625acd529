// What to capture next, so that effects that look alike come apart.
#pragma once

#include <string>
#include <string_view>

namespace msi
{

// The capture that shows this effect by itself; empty where none is known.
std::string separatingCapture(std::string_view effect);

} // namespace msi

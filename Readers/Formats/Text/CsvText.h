// Fields of comma separated text.
#pragma once

#include <string>

namespace msi
{

// The text as a CSV field: quoted where it must be, inner quotes doubled.
std::string csvField(const std::string& text);

} // namespace msi

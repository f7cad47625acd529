// Text of unknown origin, before it reaches a terminal or a window.
#pragma once

#include <string>
#include <string_view>

namespace msi
{

// Control characters become \xNN, those of Unicode's second block (C2 80 .. C2 9F in UTF-8) too: names in files may
// hold sequences that move the cursor, clear the screen or rename the window. Everything else stays as it is.
std::string printable(std::string_view text);

} // namespace msi

// Fields of comma separated text.
#pragma once

#include <string>
#include <string_view>

namespace msi
{

// The text as a CSV field: quoted where it must be, inner quotes doubled.
std::string csvField(const std::string& text);

// Text for a cell that a spreadsheet program would take for a formula ("=1+1", "@name", "-a", "+a"): with an apostrophe
// before it, which such programs take for the mark of a text. Numbers stay as they are.
std::string withoutFormula(const std::string& text);
// Back: what withoutFormula was given.
std::string_view withFormula(std::string_view text);

} // namespace msi

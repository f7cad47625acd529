// Numbers as text, the same under every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace msi
{

std::string_view trimmed(std::string_view text) noexcept;
std::string lowerCase(std::string_view text);

// The whole text as one number (blanks around it and a leading + allowed), or nothing. With
// decimalComma a comma counts as the decimal point, beside the point itself.
std::optional<double> parseNumber(std::string_view text, bool decimalComma = false) noexcept;

// A whole number in the range of int, or nothing.
std::optional<int> parseInteger(std::string_view text) noexcept;

// The shortest decimal that reads back as the same number.
std::string numberText(double value);
std::string numberText(float value);

} // namespace msi

// Text of any program as UTF-8.
#pragma once

#include <optional>
#include <string>

namespace msi
{

// UTF-8 with or without a byte order mark, UTF-16 with one, else Latin-1. Nothing for damaged UTF-16.
std::optional<std::string> asUtf8(std::string text);

} // namespace msi

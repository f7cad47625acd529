// Line and column of a byte in a text.
#pragma once

#include "Formats/FormatError.h"

#include <cstddef>
#include <string>

namespace msi
{

// The place of the byte at 'offset', counted from 0; of the end where it lies beyond.
FilePlace placeOfOffset(const std::string& file, const std::string& text, std::size_t offset);

} // namespace msi

// What an image writer asks of the description it is given.
#pragma once

#include "Formats/SpectralImageFile.h"

namespace msi
{

// Throws std::invalid_argument, naming both numbers, unless the image has pixels and bands and every
// list has one entry per band or none.
void requireConsistent(const SpectralImageInfo& info);

} // namespace msi

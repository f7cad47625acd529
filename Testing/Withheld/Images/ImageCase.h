// Withheld pairs of a real and a simulated image of the same scene: every effect of images alone, pairs, none, effects that
// the library does not have, nominal cameras that are not quite right.
#pragma once

#include "Cases/CaseWriter.h"

#include <cstdint>

namespace withheld
{

void writeImageCases(CaseWriter& writer, bool full, std::uint64_t seed);
// The same pairs with noise of developed images: neighbours of the real one share it, and the simulated one has noise of its own.
void writeDevelopedImageCases(CaseWriter& writer, bool full, std::uint64_t seed);
// The same pairs with hot and dead pixels and with highlights that are not simulated.
void writeSpottedImageCases(CaseWriter& writer, bool full, std::uint64_t seed);

} // namespace withheld

// The first generator of withheld cases: a virtual bench.
#pragma once

#include "Cases/CaseWriter.h"

#include <cstdint>

namespace withheld
{

// Each effect alone, pairs and triples, none, effects that the library does not have, effects taken out of the library,
// nominal cameras that are never quite right, a third of the strength, few samples.
// Real spectra come from the folder in MULTISPECTRAL_DATA where it is set.
void writeBenchCases(CaseWriter& writer, bool full, std::uint64_t seed);

} // namespace withheld

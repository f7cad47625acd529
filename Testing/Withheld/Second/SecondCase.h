// The second generator of withheld cases, made without looking at the first: other cameras, samples, noise, formulas of
// the effects and distributions of their strengths.
#pragma once

#include "Cases/CaseWriter.h"

#include <cstdint>

namespace withheld
{

void writeSecondCases(CaseWriter& writer, bool full, std::uint64_t seed);

} // namespace withheld

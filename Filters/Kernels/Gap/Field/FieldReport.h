// What is said about the effects that were found in an image pair.
#pragma once

#include "Kernels/Gap/Field/FieldSearch.h"
#include "Kernels/Gap/GapReport.h"

#include <cstdint>
#include <vector>

namespace msi
{

// Cause by cause, the largest share first; the shares sum to `total`, less what the others undo of each times `doubt`.
std::vector<GapCause> fieldCauses(const FieldData& data, const FieldSearchResult& found,
  const std::vector<FieldChoice>& choices, double total, double doubt);

std::vector<GapCandidate> fieldCandidates(
  const FieldData& data, const FieldSearchResult& found, std::uint64_t seed);

} // namespace msi

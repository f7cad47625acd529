// What is said about each effect that was found.
#pragma once

#include "Kernels/Gap/EffectSearch.h"
#include "Kernels/Gap/GapReport.h"

#include <cstdint>
#include <string>
#include <vector>

namespace msi
{

// One cause for each effect of the fit, the largest share first. total, doubt: as causeShares.
std::vector<GapCause> describeCauses(const EffectFitter& fitter, const SearchResult& found,
  const std::vector<EffectChoice>& choices, double total, double doubt);

// The single effects by what each alone would do. seed: of the intervals.
std::vector<GapCandidate> describeCandidates(
  const EffectFitter& fitter, const SearchResult& found, std::uint64_t seed);

} // namespace msi

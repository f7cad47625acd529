// What is said about each effect that was found.
#pragma once

#include "Kernels/Gap/EffectSearch.h"
#include "Kernels/Gap/GapReport.h"

#include <cstdint>
#include <vector>

namespace msi
{

// 1 - sqrt(excess energy left / excess energy before), within [-1, 1]; 0 where there was none.
double shrinkOf(double before, double after, double noise) noexcept;

// Cross-validated shrink of a fit on its training samples, plain response units.
double shrinkOf(const EffectFitter& fitter, const EffectFit& fit);

// One cause for each effect of the fit, the largest share first. The shares are Shapley values of the shrink over
// all subsets of the effects, each fitted anew, scaled to the sum `total`; the small errors of every camera
// (EffectChoice::smallError) share what the others leave. A share then loses `doubt` (0..1) times the part that the
// other causes undo, half of the part that other causes of its medium do alike, and the part that its own parameters
// belie; so the sum can be below `total`.
std::vector<GapCause> describeCauses(const EffectFitter& fitter, const SearchResult& found,
  const std::vector<EffectChoice>& choices, double total, double doubt);

// The single effects by what each alone would do. seed: of the intervals.
std::vector<GapCandidate> describeCandidates(
  const EffectFitter& fitter, const SearchResult& found, std::uint64_t seed);

} // namespace msi

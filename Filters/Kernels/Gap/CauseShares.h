// How much of the gap each effect of a fit is given.
#pragma once

#include "Kernels/Gap/EffectFit.h"

#include <vector>

namespace msi
{

struct CauseShare
{
  double share = 0.0;
  double alone = 0.0;  // shrink by this effect alone
  double undone = 0.0; // part of what it does that the others undo, 0..1
};

// One for each effect of the fit. Shapley values of the shrink over all subsets of the effects, each fitted anew,
// scaled to the sum `total`; the small errors of every camera (EffectChoice::smallError) share what the others leave. A
// share then loses `doubt` (0..1) times the part that the other causes undo, half of the part that other causes of its
// medium do alike, and the part that its own parameters or a plainer effect belie; so the sum can be below `total`.
std::vector<CauseShare> causeShares(
  const EffectFitter& fitter, const EffectFit& fit, double total, double doubt);

} // namespace msi

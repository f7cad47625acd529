// Which form of an effect, and which of its secondary parameters, the data ask for.
#pragma once

#include "Kernels/Gap/EffectFit.h"

#include <vector>

namespace msi
{

// Does the form have parameters that are free only where the data ask for them?
bool hasSecondary(const EffectChoice& choice);

// With the secondary parameters of one effect free, where that predicts better.
EffectFit withSecondary(
  const EffectFitter& fitter, EffectFit fit, std::size_t position, const FitEffort& effort);

// Other forms of the effects in the set, and their secondary parameters.
EffectFit chooseForms(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy);

// Beside numbers of single channels all forms of a cause do equally well. The one is right that does most without them.
EffectFit leadingForms(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy);

// A passband that widens and is not balanced again is brighter, and so is a lamp with a level of its own: where plain
// exposure does as well, it is that; beside an exposure what is brighter is the exposure's, and the passband's white is
// balanced.
EffectFit preferExposure(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy);

} // namespace msi

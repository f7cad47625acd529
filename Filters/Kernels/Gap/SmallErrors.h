// Gain, center and dark of each channel: what every camera is off by a little, beside its causes.
#pragma once

#include "Kernels/Gap/EffectFit.h"

#include <vector>

namespace msi
{

// The small errors that every camera has, after the causes: gain, dark and center of each channel, where the
// cross-validation alone asks for them.
EffectFit addSmallErrors(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy);

// Gains of single channels also do what exposure and lamp do, and mend the small errors on the way. Where exposure or
// lamp alone do more of it than chance lets them, they are a cause, and the gains are what is left.
EffectFit splitGains(
  const EffectFitter& fitter, EffectFit fit, const std::vector<EffectChoice>& choices);

} // namespace msi

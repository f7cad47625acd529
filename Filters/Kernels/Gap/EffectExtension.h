// One effect more in a fitted set.
#pragma once

#include "Kernels/Gap/EffectScreen.h"

#include <vector>

namespace msi
{

// Fits current + effect for the first of the screened effects, few forms of each; secondary parameters are freed
// where the cross-validation asks for it.
std::vector<EffectFit> extendFit(const EffectFitter& fitter, const EffectFit& current,
  const std::vector<ScreenedEffect>& screened, int fullFits);

} // namespace msi

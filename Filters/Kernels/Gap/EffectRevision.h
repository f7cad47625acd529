// A set that grew effect by effect, looked at again as a whole.
#pragma once

#include "Kernels/Gap/EffectFit.h"

#include <functional>
#include <vector>

namespace msi
{

// An effect in a form that is not quite right leaves a rest that others mend, numbers of single channels above all, and
// they then hide the form that is right. Where the rest of the causes in their best forms do as well for the price, an
// effect goes.
EffectFit withoutMenders(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy);

// Drops effects again that are not worth their price.
EffectFit withoutSurplus(const EffectFitter& fitter, EffectFit fit, double gapEnergy);

// A set that grew effect by effect holds some that only suited the forms of those before them. Where another effect, the
// others in the forms that it asks for, costs less in the place of one, or with `pairs` of two, it takes it. Followed are those
// that promise to compete, so that a gap that nothing fits costs no more than a few times the search before.
EffectFit withExchanges(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy, bool pairs,
  const std::function<bool()>& stop);

} // namespace msi

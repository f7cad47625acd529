// What a set of effects costs: its cross-validated error, and what its parameters and forms are worth.
#pragma once

#include "Kernels/Gap/EffectFit.h"

namespace msi
{

// The price of one parameter in cross-validated energy: what chance gives it (half of log n times the
// dispersion), and not less than TableDecision::FormPart of the gap, because a form is an approximation and a further
// parameter mends it a little always.
double parameterPrice(const EffectFitter& fitter, double gapEnergy, double dispersion);

// Energy, price of the parameters, and what speaks against the set before the data does: late forms, and an effect of
// a medium where there is but one. `dispersion`: the same for all sets that are compared.
double costOf(
  const EffectFitter& fitter, const EffectFit& fit, double gapEnergy, double dispersion);

} // namespace msi

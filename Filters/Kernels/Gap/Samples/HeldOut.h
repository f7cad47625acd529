// What a fit leaves of samples that took no part in it.
#pragma once

#include "Kernels/Gap/Samples/EffectFit.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Observed minus predicted, K x S; 0 where nothing was measured.
// A step in time is only known to lie between two training samples; a sample between these may lie on either side of it,
// and is taken where it agrees better.
Eigen::MatrixXd leftOfHeldOut(
  const GapData& data, const EffectFit& fit, const std::vector<char>& training);

} // namespace msi

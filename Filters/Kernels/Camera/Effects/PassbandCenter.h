// Where a channel's passband sits when the light that it is known under is not even.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

namespace msi
{

// The passband's middle, nm: vertex of the parabola through the logarithm of responsivity / light over the passband's
// upper part, or over the highest value and its neighbours where the grid has fewer than three values there. So an end
// of the grid that cuts the passband does not move it, and for a Gaussian it is the center.
//
// responsivity: N, 0 or more; logLight: N, natural logarithm of the light, any constant added.
// The middle of the grid where there is no responsivity.
double passbandCenter(
  const WavelengthGrid& grid, const Eigen::ArrayXd& responsivity, const Eigen::ArrayXd& logLight);

} // namespace msi

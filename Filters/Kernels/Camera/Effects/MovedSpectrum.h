// A spectrum read at wavelengths that move while a fit runs.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

namespace msi
{

// The operator T with s(at) = T s(grid), with a continuous derivative in `at`, also where `at` passes a
// grid wavelength or an end of the grid (the interpolations of Spectra have kinks there or cost N^3).
//
// Cubic Hermite pieces; the slopes are those of the polynomial through the five nearest values. d nm beyond an
// end the spectrum is s_end + slope d / (1 + d / 20 nm): it goes on and comes to rest.
// Shape:  at.size() x grid.size(); every row sums to one. at: any wavelengths, in any order.
// Exact:  for cubics within a grid of five wavelengths or more.
// Cost:   O(at.size() + grid.size()) beside clearing the matrix.
Eigen::MatrixXd movedSpectrum(const WavelengthGrid& grid, const Eigen::ArrayXd& at);

} // namespace msi

// Carrying spectra from one wavelength grid to another.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

namespace msi
{

enum class InterpolationMethod
{
  Linear,        // piecewise linear; any grid
  CubicLagrange, // cubic through the four nearest values, as in ASTM E308; any grid
  Sprague,       // Sprague's quintic, CIE 167:2005; a uniform grid of six values or more
  CubicSpline,   // not-a-knot cubic spline; any grid of four values or more
  Recommended    // CIE 167:2005: Sprague on uniform grids, cubic spline on uneven ones, else linear
};

// What Recommended means on this grid. Never returns Recommended.
InterpolationMethod recommendedInterpolation(const WavelengthGrid& from) noexcept;

// Whether some wavelength of `to` lies outside [from.front(), from.back()] by more than 1e-6 nm.
bool needsExtrapolation(const WavelengthGrid& from, const WavelengthGrid& to) noexcept;

// The operator T with s(to) = T s(from) for spectra stored by columns.
//
// Source: Sprague coefficients and boundary values of CIE 167:2005, "Recommended practice for
//         tabulating spectral data for use in colour computations"; extrapolation by holding the
//         end value, as CIE 15:2018 advises. All methods are linear in the spectrum. On textiles
//         known at 5 nm and thinned to 10 nm, the three smooth ones miss the values left out by
//         6e-4 to 8e-4 rms in reflectance, linear interpolation by 16e-4.
// Shape:  to.size() x from.size(); every row sums to one.
// Exact:  Linear and Sprague for straight lines, CubicLagrange and CubicSpline for cubics; Sprague
//         for quartics from the third interval off each end (CIE 167 adds two values there).
//         With n < 4 values CubicLagrange has the degree n - 1.
// Errors: std::invalid_argument where the grid does not carry the method, naming what it has.
// Cost:   O(from.size() + to.size()); CubicSpline O(from.size()^3 + to.size() from.size()).
Eigen::MatrixXd resamplingMatrix(const WavelengthGrid& from, const WavelengthGrid& to,
  InterpolationMethod method = InterpolationMethod::Recommended);

} // namespace msi

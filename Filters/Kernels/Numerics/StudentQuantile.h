// Quantiles of Student's t distribution.
#pragma once

namespace msi
{

// The t for which |T| <= t has the given probability, T being Student's t with that many degrees of
// freedom. Found by bisection of the closed form for whole degrees.
//
// Source: Abramowitz and Stegun, "Handbook of Mathematical Functions", 26.7.3 and 26.7.4.
// Ranges: probability in (0, 1), degrees >= 1. Relative error below 1e-12.
double studentQuantile(double probability, int degrees);

} // namespace msi

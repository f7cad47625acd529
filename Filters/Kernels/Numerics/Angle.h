// Angles in radians.
#pragma once

namespace msi
{

inline constexpr double TwoPi = 6.283185307179586;
inline constexpr double Degree = TwoPi / 360.0;

} // namespace msi

// Other ways to state a color than XYZ and CIELAB: one record each, in one registry.
#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace msi
{

struct ColorConditions
{
  Eigen::Vector3d whitePoint; // Y = 100
  bool tenDegreeObserver = false;
};

// An immutable record.
struct ColorQuantity
{
  std::string_view name;
  // Names of the values that `of` gives first; tables get a column each.
  std::vector<std::string> components;
  std::string_view source;
  // Whether it is defined for the illuminants C, D50 and D65 alone.
  bool daylightOnly;
  // Of one color, Y = 100 for white; NaN where it is not defined.
  Eigen::Vector2d (*of)(const ColorConditions& conditions, const Eigen::Vector3d& xyz) noexcept;
};

// xyY: x, y (Y stands with XYZ). Luv: u, v of CIE 1976 L*u*v* (L* stands with CIELAB). LCh: C, h of CIELAB,
// h in degrees. whiteness: whiteness and tint of CIE 15, NaN for colors outside of its limits.
// New ones are added at the end.
const std::vector<ColorQuantity>& colorQuantities();

// Throws std::invalid_argument, listing the known names, for any other name.
const ColorQuantity& colorQuantityNamed(std::string_view name);

} // namespace msi

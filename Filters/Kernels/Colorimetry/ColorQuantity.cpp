#include "Kernels/Colorimetry/ColorQuantity.h"

#include "Kernels/Colorimetry/CIELAB.h"

#include <limits>
#include <stdexcept>

namespace msi
{

namespace
{
Eigen::Vector2d chromaticityOf(const Eigen::Vector3d& xyz) noexcept
{
  return xyz.head<2>() / xyz.sum();
}

Eigen::Vector2d chromaticityOfColor(
  const ColorConditions& /*conditions*/, const Eigen::Vector3d& xyz) noexcept
{
  return chromaticityOf(xyz);
}

Eigen::Vector2d uniformChromaticity(const Eigen::Vector3d& xyz) noexcept
{
  const double sum = xyz(0) + 15.0 * xyz(1) + 3.0 * xyz(2);
  return { 4.0 * xyz(0) / sum, 9.0 * xyz(1) / sum };
}

// 13 L* (u' - u'n), 13 L* (v' - v'n); black has no chromaticity and is neutral.
Eigen::Vector2d uvOfColor(const ColorConditions& conditions, const Eigen::Vector3d& xyz) noexcept
{
  if ((xyz.array() == 0.0).all())
  {
    return Eigen::Vector2d::Zero();
  }
  const double lightness = CIELAB(conditions.whitePoint).fromXYZ(xyz)(0);
  return 13.0 * lightness * (uniformChromaticity(xyz) - uniformChromaticity(conditions.whitePoint));
}

Eigen::Vector2d chromaAndHue(const ColorConditions& conditions, const Eigen::Vector3d& xyz) noexcept
{
  return labToLch(CIELAB(conditions.whitePoint).fromXYZ(xyz)).tail<2>();
}

// CIE 15:2018, 9.1, with its limits: 40 < W < 5 Y - 280 and -4 < T < 2 (10 degrees: -3 < T < 3).
Eigen::Vector2d whitenessAndTint(
  const ColorConditions& conditions, const Eigen::Vector3d& xyz) noexcept
{
  const Eigen::Vector2d from = chromaticityOf(conditions.whitePoint) - chromaticityOf(xyz);
  const double whiteness = xyz(1) + 800.0 * from(0) + 1700.0 * from(1);
  const bool ten = conditions.tenDegreeObserver;
  const double tint = (ten ? 900.0 : 1000.0) * from(0) - 650.0 * from(1);
  const bool within = whiteness > 40.0 && whiteness < 5.0 * xyz(1) - 280.0 &&
    tint > (ten ? -3.0 : -4.0) && tint < (ten ? 3.0 : 2.0);
  if (!within)
  {
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return { whiteness, tint };
}
}

const std::vector<ColorQuantity>& colorQuantities()
{
  static const std::vector<ColorQuantity> quantities{
    { "xyY", { "x", "y" }, "ISO/CIE 11664-3:2019", false, chromaticityOfColor },
    { "Luv", { "u", "v" }, "ISO/CIE 11664-5:2016", false, uvOfColor },
    { "LCh", { "C", "h" }, "ISO/CIE 11664-4:2019", false, chromaAndHue },
    { "whiteness", { "whiteness", "tint" }, "CIE 15:2018", true, whitenessAndTint },
  };
  return quantities;
}

const ColorQuantity& colorQuantityNamed(std::string_view name)
{
  std::string known;
  for (const ColorQuantity& quantity : colorQuantities())
  {
    if (quantity.name == name)
    {
      return quantity;
    }
    known += (known.empty() ? "" : ", ") + std::string(quantity.name);
  }
  throw std::invalid_argument(
    "there is no color quantity '" + std::string(name) + "'; expected one of " + known);
}

} // namespace msi

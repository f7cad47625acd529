// The CIE standard colorimetric observers, and observers of the user's own.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace msi
{

// The color-matching functions of one standard observer.
//
// Source: ISO/CIE 11664-1:2019; tables at 1 nm from 360 to 830 nm, compiled into the program.
class StandardObserver
{
public:
  // An observer of one's own: the rows are x-bar, y-bar and z-bar. Functions known at more than 1 nm
  // are carried to 1 nm by cubic Lagrange interpolation.
  // Throws std::invalid_argument where the sizes disagree, a value is not finite (naming its wavelength),
  // or y-bar has no positive sum.
  StandardObserver(std::string name, WavelengthGrid wavelengths, Eigen::Matrix3Xd functions);

  static const StandardObserver& cie1931TwoDegree();
  static const StandardObserver& cie1964TenDegree();

  // By its name or its short name ("2", "10"). Throws std::invalid_argument listing the names.
  static const StandardObserver& named(std::string_view name);
  // "CIE 1931 2 degree", "CIE 1964 10 degree".
  static std::vector<std::string> names();

  const std::string& name() const noexcept { return Name; }
  const WavelengthGrid& wavelengths() const noexcept { return Wavelengths; }
  // 3 x wavelengths: the rows are x-bar, y-bar and z-bar.
  const Eigen::Matrix3Xd& functions() const noexcept { return Functions; }

private:
  StandardObserver(std::string name, std::string_view table);

  std::string Name;
  WavelengthGrid Wavelengths;
  Eigen::Matrix3Xd Functions;
};

} // namespace msi

// The CIE illuminants, and illuminants of the user's own.
#pragma once

#include "Kernels/Spectra/Interpolation.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace msi
{

// A relative spectral power distribution. Its scale is free: color transforms normalize it.
//
// Source: A, D50, D65: ISO/CIE 11664-2:2022; FL1..FL12 and LED-B1..LED-B5: CIE 15:2018. Tables at
//         5 nm, compiled into the program: A, D50 and D65 over 300..780 nm, the others 380..780 nm.
// Between the table values: linear for D50 and D65, as the standard defines them; cubic for the rest.
//         So the white points of ASTM E308 and the chromaticities of CIE 15 come out for all lamps;
//         linear interpolation between their lines would miss the latter by up to 2e-4.
class Illuminant
{
public:
  // An illuminant of one's own. Throws std::invalid_argument where the sizes disagree, a power is
  // negative or not finite (naming its wavelength), or all powers are zero.
  Illuminant(std::string name, WavelengthGrid wavelengths, Eigen::VectorXd power,
    InterpolationMethod interpolation = InterpolationMethod::CubicLagrange);

  // A CIE illuminant, by name without regard to case; F1..F12 stand for FL1..FL12.
  // Throws std::invalid_argument listing the known names.
  static Illuminant named(std::string_view name);
  // A, D50, D65, FL1..FL12, LED-B1..LED-B5.
  static std::vector<std::string> names();

  const std::string& name() const noexcept { return Name; }
  const WavelengthGrid& wavelengths() const noexcept { return Wavelengths; }
  const Eigen::VectorXd& power() const noexcept { return Power; }
  InterpolationMethod interpolation() const noexcept { return Interpolation; }

  // The power on another grid; zero outside the table. No value is held, since none is known there.
  Eigen::VectorXd powerAt(const WavelengthGrid& wavelengths) const;

private:
  std::string Name;
  WavelengthGrid Wavelengths;
  Eigen::VectorXd Power;
  InterpolationMethod Interpolation;
};

} // namespace msi

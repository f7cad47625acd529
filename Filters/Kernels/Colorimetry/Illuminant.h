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
// Source: A, D50, D65: ISO/CIE 11664-2:2022; C, FL1..FL12 and the LED lamps: CIE 15:2018. Tables at
//         5 nm, compiled into the program: A, C, D50 and D65 over 300..780 nm, the others 380..780 nm.
//         Daylight of other temperatures from the components of CIE 15:2018, over 300..830 nm, with
//         their weights rounded to three decimals as it asks for; blackbodies by Planck's law with
//         c2 = 1.438776877e-2 m K.
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

  // An illuminant by name, without regard to case: one of names(); E of equal energy; F1..F12 for
  // FL1..FL12; CWF, TL83, TL84, TL85, as the trade calls FL2, FL12, FL11, FL10; D55, D75, ..: daylight
  // of the nominal 5500 K, 7500 K, .., that is of 1.4388/1.4380 times as much; D5500K: daylight of just
  // this correlated color temperature, 4000..25000 K, and D5300 without K from 1000 on; BB3200K: a blackbody,
  // 1000..100000 K, and below 4000 K "3200K" alone. Spaces do not count.
  // Throws std::invalid_argument listing the known names, or the range of the temperature.
  static Illuminant named(std::string_view name);
  // The tables: A, C, D50, D65, FL1..FL12, LED-B1..LED-B5, LED-BH1, LED-RGB1, LED-V1, LED-V2.
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

// A camera from its parts: lamp, filters, detector.
#pragma once

#include "Kernels/Camera/CameraModel.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// One bandpass filter: T(lambda) = leak + (peak - leak) 2^-(|2 (lambda - center) / width|^order).
//
// order 2 is a Gaussian; from about 8 on the passband is nearly rectangular (super-Gaussian).
// width is the full width at half maximum (of peak above leak), nm.
// Range: width > 0, order >= 1, 0 <= leak <= peak <= 1.
struct BandpassFilter
{
  double center = 550.0;
  double width = 20.0;
  double order = 2.0;
  double peak = 1.0;
  double leak = 0.0;
};

double transmittance(const BandpassFilter& filter, double wavelength) noexcept;

// Spectral radiance of a black body relative to its value at 560 nm (Planck's law, c2 = 1.438776877e-2 m K;
// at c2 = 1.435e-2 m K and 2848 K this is CIE illuminant A). Range: temperature > 0 K.
Eigen::VectorXd planckianLight(const WavelengthGrid& wavelengths, double temperature);

// Relative electrons per unit of energy of a silicon detector: absorption in a layer of the given thickness under
// a dead surface layer, antireflective coating ignored, normalised to a maximum of 1.
// Source of the absorption coefficient: M. A. Green, M. J. Keevers, Prog. Photovolt. 3 (1995) 189,
// doi:10.1002/pip.4670030303, interpolated in log(alpha) from its values every 20 nm.
// Units: thicknesses in micrometres. Range: wavelengths 360 to 1000 nm, thickness > 0, dead layer >= 0.
Eigen::VectorXd siliconDetector(
  const WavelengthGrid& wavelengths, double thickness = 5.0, double deadLayer = 0.05);

// The parts on one grid. light and detector hold one value a wavelength.
struct CameraParts
{
  Eigen::VectorXd light;
  std::vector<BandpassFilter> filters;
  Eigen::VectorXd detector;
  std::vector<std::string> channels; // empty: the filter centers in nm, as "550nm"
};

// M = light x filter x detector x step, scaled so that a perfect white gives 1 in every channel; dark = 0.
//
// Steps: trapezoid weights on an uneven grid; the plain step on a uniform one.
// Errors: std::invalid_argument for sizes that disagree, a filter out of range, or a channel that
//         receives no light on this grid.
CameraModel designCamera(const WavelengthGrid& wavelengths, const CameraParts& parts);

} // namespace msi

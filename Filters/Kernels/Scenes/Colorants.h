// Inks, pigments and dyes as absorption bands.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi::scenes
{

// One electronic band: height 1 at Center; a Gaussian in wavenumber whose two sides differ, as dyes' do
// (vibronic structure widens the short-wave side). Widths are standard deviations in nm near the center.
struct AbsorptionBand
{
  double height;
  double center;
  double shortSide;
  double longSide;
};

// A colorant: absorption per unit of concentration, as bands above a flat ground.
struct Colorant
{
  std::string name;
  std::vector<AbsorptionBand> bands;
  double ground;
};

Eigen::ArrayXd absorption(const Colorant& colorant, const WavelengthGrid& wavelengths);

// Invented sets with the bands at which such colorants are commonly found; no measured data in them.
const std::vector<Colorant>& paperInks();
const std::vector<Colorant>& fabricDyes();

// K/S of the uncoloured material.
Eigen::ArrayXd paperStock(const WavelengthGrid& wavelengths);
Eigen::ArrayXd bleachedCotton(const WavelengthGrid& wavelengths);

} // namespace msi::scenes

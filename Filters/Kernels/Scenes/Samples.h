// Printed papers and dyed fabrics: recipes, and the reflectance of their body.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace msi::scenes
{

// Reflectance of the coloured body, without surface and geometry; one column a sample.
struct Swatches
{
  std::vector<std::string> name;
  Eigen::MatrixXd body;
};

// A printed chart of 24 or 140 patches: a grey scale, single inks in steps, overprints of two.
// The patches of the small chart are chosen from the same inks. Throws for another count.
Swatches printedChart(const WavelengthGrid& wavelengths, int patchCount, std::uint64_t seed);

// Cotton dyed with one to three dyes, pale to full shades; every seed is another dyeing.
Swatches dyedFabric(const WavelengthGrid& wavelengths, int sampleCount, std::uint64_t seed);

// Cotton dyed with one dye of fabricDyes(). Throws for a name not in it.
Eigen::VectorXd dyedCotton(
  const WavelengthGrid& wavelengths, const std::string& dye, double concentration);

// The yarns of a tartan: olive, scarlet, navy, pale yellow.
Eigen::MatrixXd tartanYarns(const WavelengthGrid& wavelengths);

} // namespace msi::scenes

// The two instruments of the demo: a d/8 spectrophotometer and a 45/0 camera.
#pragma once

#include "Kernels/Scenes/Samples.h"
#include "Kernels/Scenes/WovenFabric.h"

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <cstdint>

namespace msi::scenes
{

// The grid on which scenes are computed, and the one on which a spectrophotometer reports.
WavelengthGrid sceneGrid();  // 380..740 nm in 5 nm
WavelengthGrid reportGrid(); // 400..700 nm in 10 nm

// Reading of the spectrophotometer, specular component included, 10 nm triangular bandpass, with its
// repeatability as noise. Columns are samples.
Eigen::MatrixXd measuredPaper(const Eigen::MatrixXd& body, std::uint64_t seed);
Eigen::MatrixXd measuredFabric(const Eigen::MatrixXd& body, std::uint64_t seed);

// What reaches the camera at 45/0, relative to a perfect white there, on the scene grid. Paper shows little
// of its surface reflection; fabric shades itself. The camera averages another spot than the spectrophotometer.
Eigen::MatrixXd seenPaper(const Eigen::MatrixXd& measuredBody, std::uint64_t seed);
Eigen::MatrixXd seenFabric(const Eigen::MatrixXd& measuredBody, std::uint64_t seed);

// The same for one body of paper, on the spot itself.
Eigen::ArrayXd paperTowardsCamera(const Eigen::ArrayXd& body);

// The weave of one swatch: mounting and yarn differ from swatch to swatch.
Weave weaveOf(int swatch, std::uint64_t seed);

} // namespace msi::scenes

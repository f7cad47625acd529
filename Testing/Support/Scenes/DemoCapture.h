// A capture for the diagnosis: a camera as designed, and what the real one, which is not quite it, answered.
#pragma once

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi::scenes
{

// Samples in columns of the matrices.
struct DemoCapture
{
  CameraModel camera; // as designed, on sceneGrid()
  CameraNoise noise;  // of one reading
  std::vector<std::string> sample, medium;
  Eigen::VectorXd x, y, order;
  WavelengthGrid wavelengths; // of the measured reflectance
  Eigen::MatrixXd reflectance;
  std::vector<std::string> readingSample, readingRepeat;
  Eigen::MatrixXd readings; // K x readings, two a sample
};

// Printed patches and dyed swatches on one board, captured in random order in one session. The real camera's filters are
// warm (they pass waves 1.6 nm longer), its lamp gains 3 % while it warms up, and it sees 5 % less light from
// the fabric than the spectrophotometer.
DemoCapture demoCapture();

} // namespace msi::scenes

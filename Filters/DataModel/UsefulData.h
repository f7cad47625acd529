// Data that are there and mean nothing.
#ifndef UsefulData_h
#define UsefulData_h

#include "Kernels/Camera/CameraModel.h"

#include <Eigen/Core>

#include <string>

namespace msi
{

// Throws std::invalid_argument for responses (channels x samples) that are 0, or in several samples the same.
void requireResponsesThatChange(const Eigen::MatrixXd& response, const std::string& nameOfTable);

// The first channel of a camera that answers to no light, or by more than half to wavelengths at which no reflectance was
// measured, in words; also a camera of one wavelength. Empty where there is none.
std::string uselessChannel(
  const CameraModel& camera, const WavelengthGrid& measured, const std::string& nameOfTable);

} // namespace msi

#endif

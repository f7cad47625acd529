// The ideal response of a camera: no noise, no unmodelled effect.
#pragma once

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Estimation/AffineTransform.h"

namespace msi
{

// u = M r + b (Eq. 3 of the source named in CameraModel.h), from N reflectances to K responses a column.
// A response's bytes depend on its own reflectance alone; accuracy and cost as stated for AffineTransform.
inline AffineTransform cameraResponse(const CameraModel& camera)
{
  Eigen::MatrixXd coefficients(camera.channelCount(), camera.wavelengths().size() + 1);
  coefficients << camera.responsivity(), camera.dark();
  return AffineTransform(std::move(coefficients));
}

} // namespace msi

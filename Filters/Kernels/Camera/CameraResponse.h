// The ideal response of a camera: no noise, no unmodelled effect.
#pragma once

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Numerics/AffineTransform.h"

namespace msi
{

// u = M r + b (Eq. 3 of the source named in CameraModel.h), from N reflectances to K responses a column.
// A response's bytes depend on its own reflectance alone; accuracy and cost as stated for AffineTransform.
inline AffineTransform cameraResponse(
  const Eigen::MatrixXd& responsivity, const Eigen::VectorXd& dark)
{
  Eigen::MatrixXd coefficients(responsivity.rows(), responsivity.cols() + 1);
  coefficients << responsivity, dark;
  return AffineTransform(std::move(coefficients));
}

inline AffineTransform cameraResponse(const CameraModel& camera)
{
  return cameraResponse(camera.responsivity(), camera.dark());
}

} // namespace msi

// The check that every class built on a white point makes.
#pragma once

#include "Kernels/Spectra/Reject.h"

#include <Eigen/Core>

#include <stdexcept>

namespace msi
{

// Y of the perfect diffuser, to which XYZ is scaled.
inline constexpr double WhiteY = 100.0;

// The white point itself; throws std::invalid_argument unless it is finite and positive.
inline Eigen::Vector3d validWhitePoint(const Eigen::Vector3d& whitePoint)
{
  if (!whitePoint.allFinite() || !(whitePoint.minCoeff() > 0.0))
  {
    reject("the white point is ", whitePoint(0), ", ", whitePoint(1), ", ", whitePoint(2),
      "; expected three finite values above zero");
  }
  return whitePoint;
}

} // namespace msi

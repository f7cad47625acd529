// The check that every class built on a white point makes.
#pragma once

#include <Eigen/Core>

#include <sstream>
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
    std::ostringstream message;
    message << "the white point is " << whitePoint(0) << ", " << whitePoint(1) << ", "
            << whitePoint(2) << "; expected three finite values above zero";
    throw std::invalid_argument(message.str());
  }
  return whitePoint;
}

} // namespace msi

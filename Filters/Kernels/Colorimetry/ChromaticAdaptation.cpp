#include "Kernels/Colorimetry/ChromaticAdaptation.h"

#include <Eigen/LU>

#include <stdexcept>

namespace msi
{

std::vector<std::string> chromaticAdaptationNames()
{
  return { "Bradford", "CAT16" };
}

ChromaticAdaptation chromaticAdaptationNamed(std::string_view name)
{
  if (name == "Bradford")
  {
    return ChromaticAdaptation::Bradford;
  }
  if (name == "CAT16")
  {
    return ChromaticAdaptation::CAT16;
  }
  throw std::invalid_argument(
    "there is no chromatic adaptation '" + std::string(name) + "'; expected Bradford or CAT16");
}

Eigen::Matrix3d adaptationMatrix(
  ChromaticAdaptation method, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  Eigen::Matrix3d cones;
  if (method == ChromaticAdaptation::Bradford)
  {
    cones << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
  }
  else
  {
    cones << 0.401288, 0.650173, -0.051461, -0.250268, 1.204414, 0.045854, -0.002079, 0.048952,
      0.953127;
  }
  const Eigen::Vector3d scale = (cones * to).array() / (cones * from).array();
  return cones.inverse() * scale.asDiagonal() * cones;
}

} // namespace msi

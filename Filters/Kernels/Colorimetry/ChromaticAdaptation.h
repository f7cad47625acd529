// From the colors that one white makes to those that another white makes of the same things.
#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace msi
{

enum class ChromaticAdaptation
{
  Bradford, // linear Bradford, ICC.1:2022, annex E
  CAT16     // Li and others, 2017, doi 10.1002/col.22131, with full adaptation
};

// "Bradford", "CAT16". chromaticAdaptationNamed throws std::invalid_argument listing the names.
std::vector<std::string> chromaticAdaptationNames();
ChromaticAdaptation chromaticAdaptationNamed(std::string_view name);

// XYZ to XYZ; the white `from` becomes `to`. For whites that are finite and positive.
Eigen::Matrix3d adaptationMatrix(
  ChromaticAdaptation method, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

} // namespace msi

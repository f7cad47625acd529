// Where along an axis a gap is largest.
#pragma once

#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// The cells of an axis with the largest shares of the gap's energy, at most five: channels, media, scenes, thirds
// of the field, quintiles of level, fifths of the order, thirds of the reflectance's slope, samples.
std::vector<GapCell> worstCells(
  const GapData& data, const Eigen::MatrixXd& gap, const std::string& axis);

} // namespace msi

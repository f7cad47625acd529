// Patches that stand in rows and columns, among regions that need not all be patches.
#pragma once

#include "Kernels/Sampling/EvenRegions.h"

#include <Eigen/Core>

#include <map>
#include <utility>
#include <vector>

namespace msi
{

// Regions at whole numbers (column, row) of a lattice seen in perspective. The first axis turns into the second one
// clockwise as seen in an image whose rows run downward; where they begin and end is arbitrary.
struct PatchLattice
{
  std::map<std::pair<int, int>, Eigen::Vector2d> places; // (column, row) to the place in the image
  Eigen::Matrix3d toImage = Eigen::Matrix3d::Identity(); // from (column, row)
  double residual = 0.0; // rms distance of the places from the fitted ones, in cells
};

// Lattices with at least `least` regions, the one with the most first; of lattices that share most of their regions the
// one in the smallest box is given. A region is reached from its neighbours: it lies within a quarter of a cell of where they point and has
// between a half and twice their area. Then one homography is fitted, and regions more than 0.2 cells from it leave.
std::vector<PatchLattice> findLattices(
  const std::vector<EvenRegion>& regions, std::size_t least, std::size_t most = 4);

} // namespace msi

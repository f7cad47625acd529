// Those of several that fit nothing: samples or blocks of pixels with a wrong label, dust or glare.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace msi
{

using IndexList = std::vector<Eigen::Index>;

// Numbers of those that are few, with those left out before, and far beyond most others in what is left of them, which is much
// of all that is left. left: squares, of each, over what noise allows.
IndexList oddOnes(const std::vector<double>& left, std::size_t leftOut = 0);

// Those of the elements of several groups (channels of samples, pixels of blocks), by what is usual for their kind, and all elements of
// groups that are odd or of which more than a quarter is.
//
// left: as above, a column a group; NaN: there is none. kind: of each element, from 0 on. leftOut: elements.
// Returns places in `left`, column by column, ascending.
IndexList oddElements(
  const Eigen::MatrixXd& left, const Eigen::MatrixXi& kind, std::size_t leftOut = 0);

} // namespace msi

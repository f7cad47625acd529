// Those of several that fit nothing: samples or blocks of pixels with a wrong label, dust or glare.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace msi
{

using IndexList = std::vector<Eigen::Index>;

// Numbers of those that are few, with those left out before, and far beyond most others in what is left of them, which is much
// of all that is left. left: squares, of each, over what noise allows.
IndexList oddOnes(const Eigen::VectorXd& left, std::size_t leftOut = 0);

} // namespace msi

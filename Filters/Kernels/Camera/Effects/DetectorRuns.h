// Values of a block in runs that lie one after the other.
#pragma once

#include "Kernels/Camera/Effects/EffectOperators.h"

#include <algorithm>
#include <cstddef>

namespace msi
{

// Calls body(values, count) for all values, together where they lie one after the other, else column by column.
template <typename Scalar, typename Body>
void forRuns(Block<Scalar> block, Body body) noexcept
{
  const bool together = block.outerStride() == block.rows();
  const Eigen::Index runs = together ? std::min<Eigen::Index>(block.cols(), 1) : block.cols();
  const Eigen::Index columns = together ? block.cols() : 1;
  for (Eigen::Index j = 0; j < runs; ++j)
  {
    body(block.col(j).data(), static_cast<std::size_t>(block.rows() * columns));
  }
}

} // namespace msi

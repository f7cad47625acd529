// Which blocks go together into a fold.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace msi
{

// Draws at most `most` blocks and deals them to folds and test, whole groups at a time: what errs in one block (a material whose
// color is simulated wrongly) errs in its neighbours, too, and may not vouch for itself.
// A group is a label or, without labels or where a label covers much, one of about 96 cells of the image.
void dealBlocks(
  const FieldPair& pair, std::vector<FieldBlock>& blocks, std::size_t most, std::uint64_t seed);

// Sums of the blocks' numbers over groups: of the training blocks, or of the test blocks.
std::vector<double> groupSums(const FieldData& data, const Eigen::VectorXd& ofBlock, bool training);

} // namespace msi

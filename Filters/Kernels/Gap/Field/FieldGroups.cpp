#include "Kernels/Gap/Field/FieldData.h"

#include "Kernels/Numerics/CounterRandom.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace msi
{

namespace
{
constexpr double Cells = 96.0;
constexpr std::size_t FewestGroups = 12;
constexpr std::size_t LargestLabel = 8; // part of the blocks, 1 / this
constexpr double TestPart = 1.0 / 3.0;

using Group = std::pair<int, int>; // label, cell

std::vector<std::size_t> shuffled(std::size_t count, const CounterRandom& random)
{
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return random.uniform(a) < random.uniform(b); });
  return order;
}

// Numbers the groups from 0; returns how many there are.
std::size_t group(std::vector<FieldBlock>& blocks, const std::vector<Group>& keys)
{
  std::map<Group, int> number;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    blocks[b].group = number.emplace(keys[b], static_cast<int>(number.size())).first->second;
  }
  return number.size();
}

std::size_t findGroups(const FieldPair& pair, std::vector<FieldBlock>& blocks)
{
  const double side = std::sqrt(static_cast<double>(pair.pixels()) / Cells);
  const int columns = static_cast<int>(pair.extent.width / side) + 1;
  std::vector<Group> cells;
  std::vector<Group> labels;
  std::map<int, std::size_t> count;
  for (const FieldBlock& block : blocks)
  {
    const int x = block.window.x + block.window.width / 2;
    const int y = block.window.y + block.window.height / 2;
    const int cell = static_cast<int>(y / side) * columns + static_cast<int>(x / side);
    const int label = pair.labels == nullptr ? 0 : pair.labels[pair.index(x, y)];
    cells.emplace_back(0, cell);
    labels.emplace_back(label, cell);
    ++count[label];
  }
  for (Group& key : labels)
  {
    if (key.first != 0 && count[key.first] * LargestLabel <= blocks.size())
    {
      key.second = -1;
    }
  }
  const std::size_t found = group(blocks, labels);
  return found >= FewestGroups ? found : group(blocks, cells);
}
}

void dealBlocks(
  const FieldPair& pair, std::vector<FieldBlock>& blocks, std::size_t most, std::uint64_t seed)
{
  std::vector<std::size_t> order = shuffled(blocks.size(), CounterRandom(seed, 81));
  order.resize(std::min(order.size(), most));
  std::vector<FieldBlock> drawn;
  drawn.reserve(order.size());
  for (const std::size_t b : order)
  {
    drawn.push_back(std::move(blocks[b]));
  }
  blocks = std::move(drawn);
  const std::size_t groups = findGroups(pair, blocks);
  std::vector<double> size(groups, 0.0);
  for (const FieldBlock& block : blocks)
  {
    size[static_cast<std::size_t>(block.group)] += 1.0;
  }
  // Each group goes where most is missing: to the test blocks or a fold.
  using Parts = Eigen::Array<double, FieldFolds + 1, 1>;
  Parts part = Parts::Constant((1.0 - TestPart) / FieldFolds);
  part[FieldFolds] = TestPart;
  Parts dealt = Parts::Zero();
  std::vector<int> fold(groups, -1);
  double all = 0.0;
  for (const std::size_t g : shuffled(groups, CounterRandom(seed, 82)))
  {
    all += size[g];
    Eigen::Index best = 0;
    (part * all - dealt).maxCoeff(&best);
    dealt[best] += size[g];
    fold[g] = best == FieldFolds ? -1 : static_cast<int>(best);
  }
  for (FieldBlock& block : blocks)
  {
    block.fold = fold[static_cast<std::size_t>(block.group)];
  }
}

Eigen::ArrayXd groupSums(const FieldData& data, const Eigen::VectorXd& ofBlock, bool training)
{
  std::map<int, double> sums;
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    if ((data.blocks[b].fold >= 0) == training)
    {
      sums[data.blocks[b].group] += ofBlock[static_cast<Eigen::Index>(b)];
    }
  }
  Eigen::ArrayXd values(static_cast<Eigen::Index>(sums.size()));
  std::transform(
    sums.begin(), sums.end(), values.begin(), [](const auto& group) { return group.second; });
  return values;
}

} // namespace msi

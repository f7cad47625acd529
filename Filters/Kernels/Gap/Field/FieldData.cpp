#include "Kernels/Gap/Field/FieldData.h"

#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Doubts/MixUps.h"
#include "Kernels/Gap/Field/FieldOddPixels.h"
#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Numerics/OrderStatistic.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace msi
{

namespace
{
constexpr int CellsPerSide = 64;

// Gaps in a row of one channel become the mean of both sides, weighted by nearness; `other` where the whole row is one.
void fillRow(float* row, int pixels, std::size_t step, float other)
{
  const auto at = [=](int x) -> float& { return row[x * step]; };
  int last = -1;
  for (int x = 0; x <= pixels; ++x)
  {
    if (x < pixels && !std::isfinite(at(x)))
    {
      continue;
    }
    const float right = x < pixels ? at(x) : last >= 0 ? at(last) : other;
    const float left = last >= 0 ? at(last) : right;
    for (int gap = last + 1; gap < x; ++gap)
    {
      at(gap) =
        left + static_cast<float>(gap - last) / static_cast<float>(x - last) * (right - left);
    }
    last = x;
  }
}

constexpr std::size_t LargestWhole = std::size_t(1) << 21;
constexpr int RegionSide = 512;
constexpr int Regions = 3;  // a side
constexpr int Surround = 2; // finite neighbours
constexpr int LargestMargin = 8;
constexpr std::size_t MostBlocks = 208; // with up to 8 channels; fewer with more, down to half

constexpr int LargestBlock = 16; // pixels on a side; half with ManyChannels
constexpr int SmallestBlock = 4;
constexpr std::size_t ManyChannels = 24;
constexpr std::size_t EnoughBlocks = 64;
constexpr std::size_t FewestBlocks = 15;
constexpr double UsablePart = 0.25;

constexpr double MostMean = 2.0;    // white
constexpr double OtherUnit = 5.0;   // times
constexpr double SameScale = 0.125; // relative
constexpr double Correlated = 0.25; // squared

// Of each channel.
std::vector<PairSums> channelSums(const FieldPair& pair)
{
  const std::size_t K = pair.channels.size();
  std::vector<PairSums> sums(K);
  const std::size_t step = 1 + pair.pixels() / MeanPixels;
  for (std::size_t i = 0; i < pair.pixels(); i += step)
  {
    for (std::size_t k = 0; k < K; ++k)
    {
      sums[k].add(pair.real[i * K + k], pair.simulated[i * K + k]);
    }
  }
  return sums;
}

// Highlights may pass white, but not the image as a whole.
void requireRelativeToWhite(const std::vector<PairSums>& sums)
{
  double sum = 0.0;
  double count = 0.0;
  for (const PairSums& channel : sums)
  {
    sum += channel.simulated;
    count += channel.n;
  }
  if (sum > MostMean * count)
  {
    reject("the simulated image has a mean of ", sum / count,
      ", which looks like counts; expected responses relative to white (1 = perfect white): divide "
      "both images by the counts of white");
  }
}

// The unit of each channel of the real image, where it is not that of the simulated one (white = 1): counts, say. 1 where the
// images agree within a factor of five, else the same for all channels where that is enough. A channel that does not go with the
// simulated one (a dead one) has that of the others.
Eigen::ArrayXd fieldUnits(const std::vector<PairSums>& sums)
{
  const Eigen::Index channels = sums.size();
  Eigen::ArrayXd ratio(channels);
  std::vector<double> slopes; // of straight lines where the images go together
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    const PairSums& sum = sums[k];
    if (!sum.isFlat() && !sum.isSteady() && sum.correlation() > Correlated)
    {
      ratio[k] = sum.ofBoth() / sum.ofSimulated();
      slopes.push_back(ratio[k]);
    }
    else
    {
      ratio[k] = sum.gain();
      others.push_back(k);
    }
  }
  if (!slopes.empty())
  {
    ratio(others).setConstant(orderStatistic(slopes, slopes.size() / 2));
  }
  const auto alike = [](const Eigen::ArrayXd& values)
  { return (values >= 1.0 / OtherUnit).all() && (values <= OtherUnit).all(); };
  if (alike(ratio) || !(ratio > 0.0).all())
  {
    return Eigen::ArrayXd::Ones(channels);
  }
  double common = orderStatistic(ratio, channels / 2);
  // Full scale of percent, of 8 to 16 bits, and of 10 and 12 bits in a file of 16 whose full scale is 1, if it is that; not what is
  // brighter or darker by an effect.
  for (const double scale :
    { 100.0, 255.0, 1023.0, 4095.0, 16383.0, 65535.0, 1023.0 / 65535.0, 4095.0 / 65535.0 })
  {
    common = std::fabs(common / scale - 1.0) < SameScale ? scale : common;
  }
  return alike(ratio / common) ? Eigen::ArrayXd(Eigen::ArrayXd::Constant(channels, common)) : ratio;
}

struct Region
{
  ImageWindow interior;
  ImageWindow whole;
};

std::vector<Region> regionsOf(const ImageExtent& extent)
{
  const ImageWindow image = wholeImage(extent);
  if (image.pixels() <= LargestWhole)
  {
    return { { image, image } };
  }
  std::vector<Region> regions;
  for (int j = 0; j < Regions; ++j)
  {
    for (int i = 0; i < Regions; ++i)
    {
      const int width = std::min(RegionSide, extent.width);
      const int height = std::min(RegionSide, extent.height);
      const ImageWindow whole{ (extent.width - width) * i / (Regions - 1),
        (extent.height - height) * j / (Regions - 1), width, height };
      // Where the window is cut the tail is not known.
      ImageWindow interior = whole;
      const auto cut = [](int& first, int& size, int all)
      {
        const int before = first > 0 ? splineReach(TailPasses) : 0;
        const int behind = first + size < all ? splineReach(TailPasses) : 0;
        first += before;
        size -= before + behind;
      };
      cut(interior.x, interior.width, extent.width);
      cut(interior.y, interior.height, extent.height);
      if (interior.width > 0 && interior.height > 0)
      {
        regions.push_back({ interior, whole });
      }
    }
  }
  return regions;
}

// Real values of a block, NaN where they cannot be used; returns how many pixels can.
std::size_t readBlock(const FieldData& data, FieldBlock& block)
{
  const FieldPair& pair = data.pair;
  const std::size_t K = pair.channels.size();
  const int margin = std::min(LargestMargin, std::min(pair.extent.width, pair.extent.height) / 16);
  const ImageWindow inside{ margin, margin, pair.extent.width - 2 * margin,
    pair.extent.height - 2 * margin };
  const auto isDead = [&data](std::size_t k)
  { return std::find(data.dead.begin(), data.dead.end(), k) != data.dead.end(); };
  const auto surrounded = [&](int x, int y, std::size_t k)
  {
    const ImageWindow near = grown({ x, y, 1, 1 }, Surround, pair.extent);
    bool good = true;
    for (int v = near.y; good && v < near.y + near.height; ++v)
    {
      for (int u = near.x; good && u < near.x + near.width; ++u)
      {
        good = std::isfinite(pair.simulated[pair.index(u, v) * K + k]);
      }
    }
    return good;
  };
  block.real.assign(block.window.pixels() * K, std::numeric_limits<float>::quiet_NaN());
  std::size_t usable = 0;
  float* out = block.real.data();
  for (int y = block.window.y; y < block.window.y + block.window.height; ++y)
  {
    for (int x = block.window.x; x < block.window.x + block.window.width; ++x, out += K)
    {
      bool any = false;
      for (std::size_t k = 0; k < K && inside.contains({ x, y, 1, 1 }); ++k)
      {
        const float value = pair.real[pair.index(x, y) * K + k];
        if (std::isfinite(value) && !isDead(k) && (data.filled.empty() || surrounded(x, y, k)))
        {
          out[k] = static_cast<float>(static_cast<double>(value) / data.unit[k]);
          any = true;
        }
      }
      usable += any ? 1 : 0;
    }
  }
  return usable;
}

// Those with enough usable pixels; their values are not kept, for there may be many more than are drawn.
void findBlocks(FieldData& data, const std::vector<Region>& regions, int size)
{
  data.blocks.clear();
  double looked = 0.0;
  double usable = 0.0;
  for (const Region& region : regions)
  {
    const ImageWindow& interior = region.interior;
    for (int y = interior.y; y + size <= interior.y + interior.height; y += size)
    {
      for (int x = interior.x; x + size <= interior.x + interior.width; x += size)
      {
        FieldBlock block;
        block.window = { x, y, size, size };
        const auto pixels = static_cast<double>(block.window.pixels());
        const auto count = static_cast<double>(readBlock(data, block));
        looked += pixels;
        usable += count;
        if (count >= UsablePart * pixels)
        {
          block.real = {};
          data.blocks.push_back(std::move(block));
        }
      }
    }
  }
  data.usablePart = usable / std::fmax(looked, 1.0);
}

void addTails(FieldData& data, const Region& region)
{
  const std::size_t K = data.pair.channels.size();
  PixelBuffer buffer;
  buffer.resize(region.whole, static_cast<int>(K));
  for (int y = region.whole.y; y < region.whole.y + region.whole.height; ++y)
  {
    std::copy_n(data.scene() + data.pair.index(region.whole.x, y) * K, region.whole.width * K,
      buffer.pixel(region.whole.x, y));
  }
  for (int pass = 0; pass < TailPasses; ++pass)
  {
    convolve(splineKernel(buffer.channels, 1 << pass), buffer);
    for (FieldBlock& block : data.blocks)
    {
      if (!region.interior.contains(block.window))
      {
        continue;
      }
      const ImageWindow& window = block.window;
      block.tail.resize(window.pixels() * K * TailPasses);
      double* out = block.tail.data() + pass;
      for (int y = window.y; y < window.y + window.height; ++y)
      {
        const float* row = buffer.pixel(window.x, y);
        for (std::size_t i = 0; i < window.width * K; ++i)
        {
          *out = static_cast<double>(row[i]);
          out += TailPasses;
        }
      }
    }
  }
}

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

SceneCells::SceneCells(const FieldPair& pair)
{
  const Eigen::Index K = pair.channels.size();
  Part = X = Y = Eigen::ArrayXXd::Zero(Eigen::Index{ CellsPerSide } * CellsPerSide, K);
  Eigen::ArrayXd count = Eigen::ArrayXd::Zero(K);
  const auto visit = [&](int x, int y, Eigen::Index cell)
  {
    const float* values = pair.simulated + pair.index(x, y) * K;
    for (Eigen::Index k = 0; k < K; ++k)
    {
      if (std::isfinite(values[k]))
      {
        const auto u = static_cast<double>(values[k]);
        Part(cell, k) += u;
        X(cell, k) += u * pair.fieldX(x);
        Y(cell, k) += u * pair.fieldY(y);
        count[k] += 1.0;
      }
    }
  };
  forPixels(pair, CellsPerSide, CellsPerSide, visit);
  const auto light = Part.abs() > 1e-12;
  X = light.select(X / Part, 0.0);
  Y = light.select(Y / Part, 0.0);
  Part.rowwise() /= count.max(1.0).transpose();
}

Eigen::ArrayXd SceneCells::mean(const FieldModel& model) const
{
  const FieldFactor factor(model);
  const Eigen::ArrayXXd factors =
    X.binaryExpr(Y, [&factor](double x, double y) { return factor(x, y); });
  return (Part * factors).colwise().sum().transpose();
}

std::vector<float> filledScene(const FieldPair& pair)
{
  const std::size_t K = pair.channels.size();
  const std::size_t count = pair.pixels() * K;
  if (std::all_of(
        pair.simulated, pair.simulated + count, [](float value) { return std::isfinite(value); }))
  {
    return {};
  }
  std::vector<float> filled(pair.simulated, pair.simulated + count);
  const Eigen::ArrayXd mean = SceneCells(pair).mean(FieldModel(K));
  for (int y = 0; y < pair.extent.height; ++y)
  {
    for (std::size_t k = 0; k < K; ++k)
    {
      fillRow(filled.data() + pair.index(0, y) * K + k, pair.extent.width, K,
        static_cast<float>(mean[k]));
    }
  }
  return filled;
}

FieldData prepareFieldData(const FieldPair& pair, std::uint64_t seed, FieldLoop loop)
{
  if (pair.extent.width < 1 || pair.extent.height < 1 || pair.channels.empty())
  {
    reject("the images have ", pair.extent.width, " x ", pair.extent.height, " pixels and ",
      pair.channels.size(), " channels; expected at least one of each");
  }
  FieldData data;
  data.loop = std::move(loop);
  data.pair = withoutFrame(pair);
  const std::vector<PairSums> sums = channelSums(data.pair);
  requireRelativeToWhite(sums);
  data.filled = filledScene(data.pair);
  data.unit = fieldUnits(sums);
  data.dead = deadChannels(sums);
  const auto regions = regionsOf(pair.extent);
  const int largest = pair.channels.size() < ManyChannels ? LargestBlock : LargestBlock / 2;
  for (int size = largest; size >= SmallestBlock; size /= 2)
  {
    findBlocks(data, regions, size);
    if (data.blocks.size() >= EnoughBlocks)
    {
      break;
    }
  }
  if (data.blocks.size() < FewestBlocks)
  {
    reject("the images share ", data.blocks.size(), " blocks of ", SmallestBlock, " x ",
      SmallestBlock, " usable pixels; expected at least ", FewestBlocks,
      ": pixels must be finite in both images, with finite neighbours in the simulated one");
  }
  dealBlocks(data.pair, data.blocks,
    std::clamp(8 * MostBlocks / pair.channels.size(), MostBlocks / 2, MostBlocks), seed);
  data.cells = SceneCells(data.pair);
  data.forBlocks([&](int b) { readBlock(data, data.blocks[b]); });
  data.loop(static_cast<int>(regions.size()), [&](int i) { addTails(data, regions[i]); });
  return data;
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
    size[block.group] += 1.0;
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
    block.fold = fold[block.group];
  }
}

Eigen::ArrayXd groupSums(const FieldData& data, const Eigen::VectorXd& ofBlock, bool training)
{
  std::map<int, double> sums;
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    if ((data.blocks[b].fold >= 0) == training)
    {
      sums[data.blocks[b].group] += ofBlock[b];
    }
  }
  Eigen::ArrayXd values(sums.size());
  std::transform(
    sums.begin(), sums.end(), values.begin(), [](const auto& group) { return group.second; });
  return values;
}

} // namespace msi

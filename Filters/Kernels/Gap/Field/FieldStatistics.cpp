#include "Kernels/Gap/Field/FieldStatistics.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/SetSearch.h"
#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Numerics/LowerTriangle.h"
#include "Kernels/Numerics/OrderStatistic.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace msi
{

namespace
{
constexpr double Trimmed = 0.1; // on each side
constexpr double Unusual = 4.0; // times the median: not noise
constexpr std::size_t LevelBins = 4;
constexpr double Unequal = 1.1; // differences along one axis this much above the other's: banding
constexpr double LeastNoise = 1e-5;
constexpr Eigen::Index LongestLag = 3; // pixels
constexpr double LeastOfNoise = 0.25;  // that a strong blur leaves of what noise adds
constexpr double FewestPairs = 4.0;    // in a block that tells the noise

// Of those that are noise.
double trimmedMean(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::upper_bound(values.begin(), values.end(), Unusual * values[values.size() / 2]),
    values.end());
  const auto cut = static_cast<std::ptrdiff_t>(Trimmed * static_cast<double>(values.size()));
  return std::accumulate(values.begin() + cut, values.end() - cut, 0.0) /
    static_cast<double>(values.end() - values.begin() - 2 * cut);
}

// The variance of a pixel by the difference of two means, as if noise were white; 0: nothing known.
double varianceByMeans(const Eigen::ArrayXXd& one, const Eigen::ArrayXXd& other)
{
  const auto pixels = [](const Eigen::ArrayXXd& half)
  { return static_cast<double>(half.isFinite().count()); };
  const auto mean = [&](const Eigen::ArrayXXd& half)
  { return half.isFinite().select(half, 0.0).sum() / pixels(half); };
  const double share = 1.0 / pixels(one) + 1.0 / pixels(other);
  const double difference = mean(one) - mean(other);
  return std::isfinite(share) ? difference * difference / share : 0.0;
}

// Mean squared differences over the pairs of usable pixels that lie `lag` apart, and of the block's halves.
void addDifferences(const ChannelColumns& found, const ImageWindow& window, BlockSums& sums)
{
  const Eigen::Index lag =
    std::min<Eigen::Index>(LongestLag, std::min(window.width, window.height) / 2);
  const auto residual = found.residual();
  // Of every pixel of the block, NaN where it is not usable.
  Eigen::ArrayXXd left = Eigen::ArrayXXd::Constant(
    window.width, window.height, std::numeric_limits<double>::quiet_NaN());
  Eigen::ArrayXXd level = left;
  left.reshaped()(found.pixel) = residual;
  level.reshaped()(found.pixel) = found.level;
  double slope = 0.0;
  double pairs = 0.0;
  // Half the mean squared difference to the pixels at this place from each.
  const auto difference = [&](Eigen::Index right, Eigen::Index down)
  {
    const auto change = [&](const Eigen::ArrayXXd& values) -> Eigen::ArrayXXd
    {
      const Eigen::Index width = values.rows() - right;
      const Eigen::Index height = values.cols() - down;
      return (values.bottomRightCorner(width, height) - values.topLeftCorner(width, height))
        .square();
    };
    const Eigen::ArrayXXd squares = change(left);
    const Eigen::ArrayXXd slopes = change(level);
    const auto count = static_cast<double>(squares.isFinite().count());
    slope += slopes.isFinite().select(slopes, 0.0).sum();
    pairs += count;
    return count < FewestPairs ? 0.0 : 0.5 * squares.isFinite().select(squares, 0.0).sum() / count;
  };
  sums.difference = difference(lag, 0);
  sums.differenceDown = difference(0, lag);
  sums.gradient = slope / std::fmax(pairs, 1.0);
  sums.halves = 0.5 *
    (varianceByMeans(left.topRows(window.width / 2), left.bottomRows(window.width / 2)) +
      varianceByMeans(left.leftCols(window.height / 2), left.rightCols(window.height / 2)));
}

using BlockPointers = std::vector<const BlockSums*>;

// The smoother half of the blocks, of a channel.
BlockPointers smoothBlocks(const FieldStatistics& statistics, Eigen::Index channel)
{
  BlockPointers smooth;
  for (std::size_t b = 0; b < statistics.blocks(); ++b)
  {
    const BlockSums& sums = statistics.at(b, channel);
    if (sums.difference > 0.0 && sums.differenceDown > 0.0)
    {
      smooth.push_back(&sums);
    }
  }
  std::stable_sort(smooth.begin(), smooth.end(),
    [](const BlockSums* a, const BlockSums* b) { return a->gradient < b->gradient; });
  smooth.resize((smooth.size() + 1) / 2);
  return smooth;
}

// Least squares. How well the numbers are known is seen by how the values scatter (a sandwich).
struct Regression
{
  Regression(const Eigen::MatrixXd& known, const Eigen::VectorXd& values)
  {
    const Eigen::MatrixXd inverse = known.completeOrthogonalDecomposition().pseudoInverse();
    number = inverse * values;
    error = (inverse * (values - known * number).asDiagonal()).rowwise().norm();
  }
  bool isSure(Eigen::Index n) const { return number[n] > Decision::SureDeviations * error[n]; }

  Eigen::VectorXd number, error;
};

double sceneNoiseOf(const FieldStatistics& statistics, Eigen::Index channel)
{
  enum Column : Eigen::Index
  {
    Gain,
    Offset,
    Blur,
    Residual
  };
  const std::array<int, 4> there{ fieldColumns().gain, fieldColumns().offset, fieldColumns().blur,
    fieldColumns().residual };
  const Eigen::Index blocks = statistics.blocks();
  std::vector<Eigen::Matrix4d> normals;
  Eigen::Matrix4d all = Eigen::Matrix4d::Zero();
  for (Eigen::Index b = 0; b < blocks; ++b)
  {
    normals.emplace_back(statistics.at(b, channel).normal()(there, there));
    all += normals.back();
  }
  const Eigen::Vector2d line = all.topLeftCorner<2, 2>().ldlt().solve(all.col(Residual).head<2>());
  // product = noise x what it adds + blur x square, of each block; all over the deviation that the product has.
  Eigen::MatrixX2d known = Eigen::MatrixX2d::Zero(blocks, 2);
  Eigen::VectorXd product = Eigen::VectorXd::Zero(blocks);
  double square = 0.0;
  double added = 0.0;
  for (Eigen::Index b = 0; b < blocks; ++b)
  {
    const BlockSums& sums = statistics.at(b, channel);
    const Eigen::Matrix4d& normal = normals[b];
    const double size = std::sqrt(normal(Blur, Blur));
    if (size > 0.0)
    {
      known.row(b) << sums.pixels * sums.residualOfNoise / size, size;
      product[b] = (normal(Blur, Residual) - normal.row(Blur).head<2>().dot(line)) / size;
      square += sums.blurOfNoise;
      added += sums.residualOfNoise;
    }
  }
  const Regression found(known, product);
  return found.isSure(0)
    ? found.number[0] / std::fmax(1.0 - found.number[1] * square / added, LeastOfNoise)
    : 0.0;
}
}

Eigen::MatrixXd BlockSums::normal() const
{
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(fieldColumns().count, fieldColumns().count);
  whole(there, there) = products;
  return whole;
}

double BlockSums::energyLeft(const Eigen::VectorXd& change) const
{
  if (there.empty())
  {
    return 0.0;
  }
  const std::vector<Eigen::Index> columns(there.begin(), there.end() - 1);
  return msi::energyLeft(products, change(columns));
}

Eigen::VectorXd FieldStatistics::ofBlocks(double BlockSums::*number) const
{
  Eigen::VectorXd together = Eigen::VectorXd::Zero(blocks());
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    together[i / channels] += sums[i].*number;
  }
  return together;
}

double noiseCoherence(const FieldStatistics& statistics, Eigen::Index channel)
{
  std::vector<double> ratios;
  for (const BlockSums* block : smoothBlocks(statistics, channel))
  {
    if (block->halves > 0.0)
    {
      ratios.push_back(block->halves * block->pixels / block->noise);
    }
  }
  if (ratios.empty())
  {
    return 1.0;
  }
  // The mean of two squares of normal deviates has a median of log 2.
  const double median = orderStatistic(ratios, ratios.size() / 2);
  return std::fmax(median / std::log(2.0), 1.0);
}

namespace
{
// Of blocks whose differences contain this much of the squared slopes of the scene.
CameraNoise noiseOf(BlockPointers blocks, double ofSlopes)
{
  const auto without = [ofSlopes](const BlockSums* block, double difference)
  { return std::fmax(difference - ofSlopes * block->gradient, 0.0); };
  std::vector<double> across;
  std::vector<double> down;
  for (const BlockSums* block : blocks)
  {
    across.push_back(without(block, block->difference));
    down.push_back(without(block, block->differenceDown));
  }
  const double meanAcross = trimmedMean(across);
  const double meanDown = trimmedMean(down);
  std::stable_sort(blocks.begin(), blocks.end(),
    [](const BlockSums* a, const BlockSums* b) { return a->level < b->level; });
  const std::size_t bins = std::min(LevelBins, blocks.size());
  Eigen::ArrayXd level(bins);
  Eigen::ArrayXd variance(bins);
  for (std::size_t bin = 0; bin < bins; ++bin)
  {
    std::vector<double> values;
    double mean = 0.0;
    for (std::size_t i = bin * blocks.size() / bins; i < (bin + 1) * blocks.size() / bins; ++i)
    {
      const BlockSums* block = blocks[i];
      values.push_back(without(block,
        meanDown > Unequal * meanAcross     ? block->difference
          : meanAcross > Unequal * meanDown ? block->differenceDown
                                            : 0.5 * (block->difference + block->differenceDown)));
      mean += block->level;
    }
    level[bin] = mean / static_cast<double>(values.size());
    variance[bin] = trimmedMean(values);
  }
  CameraNoise noise = fittedNoise(level, variance, Eigen::ArrayXd::Ones(level.size()));
  noise.read = std::hypot(noise.read, LeastNoise);
  return noise;
}

// How much of the squared slopes of the scene the differences contain beside read and shot noise: what an effect leaves on edges is no
// noise. 0 where it is not sure.
double partOfSlopes(const BlockPointers& blocks, const CameraNoise& noise)
{
  Eigen::MatrixX3d known(blocks.size(), 3);
  Eigen::VectorXd differences(blocks.size());
  Eigen::Index count = 0;
  for (const BlockSums* block : blocks)
  {
    const double seen = noiseVariance(noise, block->level);
    known.row(count) = Eigen::RowVector3d(1.0, block->level, block->gradient) / seen;
    differences[count] = 0.5 * (block->difference + block->differenceDown) / seen;
    count += differences[count] < Unusual ? 1 : 0;
  }
  if (count < known.cols())
  {
    return 0.0;
  }
  const Regression found(known.topRows(count), differences.head(count));
  return found.isSure(2) ? found.number[2] : 0.0;
}
}

std::vector<CameraNoise> fieldNoise(const FieldStatistics& statistics)
{
  std::vector<CameraNoise> noise;
  for (Eigen::Index k = 0; k < statistics.channels; ++k)
  {
    const BlockPointers smooth = smoothBlocks(statistics, k);
    if (smooth.empty())
    {
      noise.push_back({ LeastNoise, 0.0 });
      continue;
    }
    noise.push_back(noiseOf(smooth, 0.0));
    if (const double part = partOfSlopes(smooth, noise.back()); part > 0.0)
    {
      noise.back() = noiseOf(smooth, part);
    }
  }
  return noise;
}

Eigen::ArrayXd sceneNoise(const FieldStatistics& statistics)
{
  Eigen::ArrayXd variance(statistics.channels);
  for (Eigen::Index k = 0; k < statistics.channels; ++k)
  {
    variance[k] = sceneNoiseOf(statistics, k);
  }
  return variance;
}

Eigen::ArrayXd energiesBesideGain(const std::vector<Eigen::MatrixXd>& normals, bool ofChannels)
{
  const auto of = [&normals](int row, int column)
  {
    Eigen::ArrayXd sums(normals.size());
    std::transform(normals.begin(), normals.end(), sums.begin(),
      [row, column](const Eigen::MatrixXd& normal) { return normal(row, column); });
    return sums;
  };
  const int gain = fieldColumns().gain;
  const int residual = fieldColumns().residual;
  return energiesBesideGain(of(gain, gain), of(gain, residual), of(residual, residual), ofChannels);
}

FieldWeights fieldWeights(const FieldStatistics& statistics)
{
  FieldWeights weights;
  weights.noise = fieldNoise(statistics);
  weights.sceneNoise = sceneNoise(statistics);
  const std::vector<Eigen::MatrixXd> normals = statistics.normals([](std::size_t) { return true; });
  Eigen::ArrayXd noise = Eigen::ArrayXd::Zero(statistics.channels);
  Eigen::ArrayXd pixels = noise;
  Eigen::ArrayXd energy = noise;
  for (Eigen::Index k = 0; k < statistics.channels; ++k)
  {
    for (std::size_t b = 0; b < statistics.blocks(); ++b)
    {
      const BlockSums& sums = statistics.at(b, k);
      noise[k] += sums.pixels * noiseVariance(weights.noise[k], sums.level);
      pixels[k] += sums.pixels;
    }
    energy[k] = normals[k](fieldColumns().residual, fieldColumns().residual);
  }
  pixels = pixels.max(1.0);
  weights.limit = Decision::OutlierDeviations * (energy / pixels).sqrt();
  weights.tolerance =
    Decision::FormPart * (energiesBesideGain(normals, false) - noise).max(0.0) / pixels;
  return weights;
}

FieldStatistics fieldStatistics(const FieldData& data, const FieldModel& model,
  const FieldWeights* weights, const AskedSteps& asked)
{
  FieldStatistics statistics{ model, data.channels(), {} };
  statistics.sums.resize(data.blocks.size() * data.channels());
  const Eigen::ArrayXd glare = data.cells.mean(model);
  const auto measure = [&](int b)
  {
    const FieldBlock& block = data.blocks[b];
    const auto add = [&](Eigen::Index channel, ChannelColumns& found)
    {
      BlockSums& sums = statistics.sums[b * data.channels() + channel];
      const auto residual = found.residual();
      sums.pixels = static_cast<double>(found.pixel.size());
      sums.energy = residual.squaredNorm();
      if (sums.pixels > 0.0)
      {
        sums.mean = residual.mean();
        sums.level = found.level.mean();
        addDifferences(found, block.window, sums);
      }
      const Eigen::Index last = found.columns.cols() - 1;
      Eigen::VectorXd ofScene = Eigen::VectorXd::Zero(found.columns.cols());
      if (weights != nullptr)
      {
        const Eigen::ArrayXd variance = found.level.unaryExpr(
          [&noise = weights->noise[channel]](double level) { return noiseVariance(noise, level); });
        const double limit = weights->limit[channel];
        const Eigen::ArrayXd size = residual.array().abs();
        const Eigen::ArrayXd weight =
          (size > limit).select(limit / size, 1.0) / (variance + weights->tolerance[channel]);
        sums.noise = variance.sum();
        sums.chance = (variance * weight).sum();
        found.columns.array().colwise() *= weight.sqrt();
        if (const double scene = weights->sceneNoise[channel] * weight.sum(); scene > 0.0)
        {
          ofScene = scene * found.ofNoise(last);
          ofScene[last] -= scene;
        }
      }
      else
      {
        const auto blur = std::find(found.there.begin(), found.there.end(), fieldColumns().blur);
        const Eigen::VectorXd ofNoise = found.ofNoise(blur - found.there.begin());
        sums.blurOfNoise = ofNoise[blur - found.there.begin()];
        sums.residualOfNoise = ofNoise[last];
      }
      sums.there = found.there;
      const Eigen::MatrixXd columns = found.columns.transpose();
      sums.products.setZero(columns.rows(), columns.rows());
      addOuterProduct(sums.products, columns, columns);
      sums.products.triangularView<Eigen::StrictlyUpper>() = sums.products.transpose();
      // Squares of derivatives keep it, so that no sum of columns has a negative one.
      sums.products.rightCols<1>() -= ofScene;
      sums.products.bottomRows<1>() = sums.products.rightCols<1>().transpose();
    };
    forColumns(data, model, glare, block, asked, add);
  };
  data.forBlocks(measure);
  return statistics;
}

} // namespace msi

#include "Kernels/Gap/Field/FieldStatistics.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Numerics/LowerTriangle.h"

#include <algorithm>
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
constexpr double FewestPairs = 4.0; // in a block that tells the noise

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

// Mean squared differences over the pairs of usable pixels that lie `lag` apart.
void addDifferences(const ChannelColumns& found, const ImageWindow& window, BlockSums& sums)
{
  constexpr Eigen::Index lag = 2;
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
}
}

Eigen::MatrixXd BlockSums::normal() const
{
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(FieldColumn::count(), FieldColumn::count());
  whole(there, there) = products;
  return whole;
}

Eigen::VectorXd FieldStatistics::ofBlocks(double BlockSums::*number) const
{
  Eigen::VectorXd together = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(blocks()));
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    together[static_cast<Eigen::Index>(i) / channels] += sums[i].*number;
  }
  return together;
}

std::vector<CameraNoise> fieldNoise(const FieldStatistics& statistics)
{
  std::vector<CameraNoise> noise;
  const std::size_t blocks = statistics.blocks();
  for (Eigen::Index k = 0; k < statistics.channels; ++k)
  {
    std::vector<const BlockSums*> smooth;
    for (std::size_t b = 0; b < blocks; ++b)
    {
      if (statistics.at(b, k).difference > 0.0 && statistics.at(b, k).differenceDown > 0.0)
      {
        smooth.push_back(&statistics.at(b, k));
      }
    }
    if (smooth.empty())
    {
      noise.push_back({ LeastNoise, 0.0 });
      continue;
    }
    std::stable_sort(smooth.begin(), smooth.end(),
      [](const BlockSums* a, const BlockSums* b) { return a->gradient < b->gradient; });
    smooth.resize((smooth.size() + 1) / 2);
    std::vector<double> across;
    std::vector<double> down;
    for (const BlockSums* block : smooth)
    {
      across.push_back(block->difference);
      down.push_back(block->differenceDown);
    }
    const double meanAcross = trimmedMean(across);
    const double meanDown = trimmedMean(down);
    std::stable_sort(smooth.begin(), smooth.end(),
      [](const BlockSums* a, const BlockSums* b) { return a->level < b->level; });
    const std::size_t bins = std::min(LevelBins, smooth.size());
    Eigen::ArrayXd level(static_cast<Eigen::Index>(bins));
    Eigen::ArrayXd variance(level.size());
    for (std::size_t bin = 0; bin < bins; ++bin)
    {
      std::vector<double> values;
      double mean = 0.0;
      for (std::size_t i = bin * smooth.size() / bins; i < (bin + 1) * smooth.size() / bins; ++i)
      {
        values.push_back(meanDown > Unequal * meanAcross ? smooth[i]->difference
            : meanAcross > Unequal * meanDown
            ? smooth[i]->differenceDown
            : 0.5 * (smooth[i]->difference + smooth[i]->differenceDown));
        mean += smooth[i]->level;
      }
      level[static_cast<Eigen::Index>(bin)] = mean / static_cast<double>(values.size());
      variance[static_cast<Eigen::Index>(bin)] = trimmedMean(values);
    }
    noise.push_back(fittedNoise(level, variance, Eigen::ArrayXd::Ones(level.size())));
    noise.back().read = std::hypot(noise.back().read, LeastNoise);
  }
  return noise;
}

Eigen::ArrayXd energyBesideGain(const std::vector<Eigen::MatrixXd>& normals)
{
  double square = 0.0; // of the response
  double gained = 0.0; // times the residual
  for (const Eigen::MatrixXd& normal : normals)
  {
    square += normal(FieldColumn::gain(), FieldColumn::gain());
    gained += normal(FieldColumn::gain(), FieldColumn::residual());
  }
  Eigen::VectorXd change = Eigen::VectorXd::Zero(FieldColumn::residual());
  change[FieldColumn::gain()] = Decision::largeGain(gained / std::fmax(square, 1e-30));
  Eigen::ArrayXd energy(static_cast<Eigen::Index>(normals.size()));
  std::transform(normals.begin(), normals.end(), energy.begin(),
    [&change](const Eigen::MatrixXd& normal) { return energyLeft(normal, change); });
  return energy;
}

FieldWeights fieldWeights(const FieldStatistics& statistics)
{
  FieldWeights weights;
  weights.noise = fieldNoise(statistics);
  std::vector<Eigen::MatrixXd> normals;
  Eigen::ArrayXd noise = Eigen::ArrayXd::Zero(statistics.channels);
  Eigen::ArrayXd pixels = noise;
  Eigen::ArrayXd energy = noise;
  for (Eigen::Index k = 0; k < statistics.channels; ++k)
  {
    normals.emplace_back(Eigen::MatrixXd::Zero(FieldColumn::count(), FieldColumn::count()));
    for (std::size_t b = 0; b < statistics.blocks(); ++b)
    {
      const BlockSums& sums = statistics.at(b, k);
      normals.back() += sums.normal();
      noise[k] +=
        sums.pixels * noiseVariance(weights.noise[static_cast<std::size_t>(k)], sums.level);
      pixels[k] += sums.pixels;
    }
    energy[k] = normals.back()(FieldColumn::residual(), FieldColumn::residual());
  }
  pixels = pixels.max(1.0);
  weights.limit = Decision::OutlierDeviations * (energy / pixels).sqrt();
  weights.tolerance = Decision::FormPart * (energyBesideGain(normals) - noise).max(0.0) / pixels;
  return weights;
}

FieldStatistics fieldStatistics(const FieldData& data, const FieldModel& model,
  const FieldWeights* weights, const FieldLoop& loop, const AskedSteps& asked)
{
  FieldStatistics statistics{ model, data.channels(), {} };
  const auto K = static_cast<std::size_t>(data.channels());
  statistics.sums.resize(data.blocks.size() * K);
  const Eigen::ArrayXd glare = data.cells.mean(model);
  const auto measure = [&](int b)
  {
    const FieldBlock& block = data.blocks[static_cast<std::size_t>(b)];
    const auto add = [&](Eigen::Index channel, ChannelColumns& found)
    {
      const auto k = static_cast<std::size_t>(channel);
      BlockSums& sums = statistics.sums[static_cast<std::size_t>(b) * K + k];
      const auto residual = found.residual();
      sums.pixels = static_cast<double>(found.pixel.size());
      sums.energy = residual.squaredNorm();
      if (sums.pixels > 0.0)
      {
        sums.mean = residual.mean();
        sums.level = found.level.mean();
        addDifferences(found, block.window, sums);
      }
      if (weights != nullptr)
      {
        const Eigen::ArrayXd variance = found.level.unaryExpr(
          [&noise = weights->noise[k]](double level) { return noiseVariance(noise, level); });
        const double limit = weights->limit[channel];
        const Eigen::ArrayXd size = residual.array().abs();
        const Eigen::ArrayXd weight =
          (size > limit).select(limit / size, 1.0) / (variance + weights->tolerance[channel]);
        sums.noise = variance.sum();
        sums.chance = (variance * weight).sum();
        found.columns.array().colwise() *= weight.sqrt();
      }
      sums.there = found.there;
      const Eigen::MatrixXd columns = found.columns.transpose();
      sums.products.setZero(columns.rows(), columns.rows());
      addOuterProduct(sums.products, columns, columns);
      sums.products.triangularView<Eigen::StrictlyUpper>() = sums.products.transpose();
    };
    forColumns(data, model, glare, block, asked, add);
  };
  loop(static_cast<int>(data.blocks.size()), measure);
  return statistics;
}

} // namespace msi

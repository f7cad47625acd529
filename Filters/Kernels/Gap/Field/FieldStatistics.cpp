#include "Kernels/Gap/Field/FieldStatistics.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Numerics/LowerTriangle.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double Trimmed = 0.1; // on each side
constexpr std::size_t LevelBins = 4;
constexpr double Unequal = 1.1; // differences along one axis this much above the other's: banding
constexpr double LeastNoise = 1e-5;
constexpr double FewestPairs = 4.0; // in a block that tells the noise

double trimmedMean(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::size_t>(Trimmed * static_cast<double>(values.size()));
  double sum = 0.0;
  for (std::size_t i = cut; i < values.size() - cut; ++i)
  {
    sum += values[i];
  }
  return sum / static_cast<double>(values.size() - 2 * cut);
}

// Mean squared differences over the pairs of usable pixels that lie `lag` apart.
void addDifferences(const ChannelColumns& found, const ImageWindow& window, BlockSums& sums)
{
  std::vector<int> at(window.pixels(), -1);
  for (std::size_t n = 0; n < found.pixel.size(); ++n)
  {
    at[static_cast<std::size_t>(found.pixel[n])] = static_cast<int>(n);
  }
  const auto residual = found.columns.col(FieldColumn::residual());
  constexpr int lag = 2;
  double slope = 0.0;
  double pairs = 0.0;
  // Half the mean squared difference to the pixels at this place from each.
  const auto difference = [&](int right, int down)
  {
    double sum = 0.0;
    double count = 0.0;
    for (int i = 0; i < static_cast<int>(window.pixels()); ++i)
    {
      const int x = i % window.width + right;
      const int y = i / window.width + down;
      const int self = at[static_cast<std::size_t>(i)];
      const int place = y * window.width + x;
      const int other =
        x < window.width && y < window.height ? at[static_cast<std::size_t>(place)] : -1;
      if (self >= 0 && other >= 0)
      {
        sum += std::pow(residual[self] - residual[other], 2);
        slope += std::pow(found.level[self] - found.level[other], 2);
        count += 1.0;
      }
    }
    pairs += count;
    return count < FewestPairs ? 0.0 : 0.5 * sum / count;
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

FieldWeights fieldWeights(const FieldStatistics& statistics)
{
  FieldWeights weights;
  weights.noise = fieldNoise(statistics);
  weights.limit.resize(statistics.channels);
  weights.tolerance.resize(statistics.channels);
  for (Eigen::Index k = 0; k < statistics.channels; ++k)
  {
    double energy = 0.0;
    double noise = 0.0;
    double pixels = 0.0;
    for (std::size_t b = 0; b < statistics.blocks(); ++b)
    {
      const BlockSums& sums = statistics.at(b, k);
      energy += sums.energy;
      noise += sums.pixels * noiseVariance(weights.noise[static_cast<std::size_t>(k)], sums.level);
      pixels += sums.pixels;
    }
    const double variance = energy / std::fmax(pixels, 1.0);
    weights.limit[k] = Decision::OutlierDeviations * std::sqrt(variance);
    weights.tolerance[k] =
      Decision::FormPart * std::fmax(variance - noise / std::fmax(pixels, 1.0), 0.0);
  }
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
      const auto residual = found.columns.col(FieldColumn::residual());
      sums.pixels = static_cast<double>(found.pixel.size());
      sums.energy = residual.squaredNorm();
      if (sums.pixels > 0.0)
      {
        sums.mean = residual.mean();
        sums.level = found.level.mean();
        addDifferences(found, block.window, sums);
      }
      Eigen::ArrayXd root(weights != nullptr ? found.columns.rows() : 0);
      for (Eigen::Index n = 0; n < root.size(); ++n)
      {
        const double variance = noiseVariance(weights->noise[k], found.level[n]);
        const double size = std::fabs(residual[n]);
        const double limit = weights->limit[channel];
        const double weight =
          (size > limit ? limit / size : 1.0) / (variance + weights->tolerance[channel]);
        sums.noise += variance;
        sums.chance += variance * weight;
        root[n] = std::sqrt(weight);
      }
      if (weights != nullptr)
      {
        found.columns.array().colwise() *= root;
      }
      const Eigen::Array<bool, 1, Eigen::Dynamic> any =
        (found.columns.array() != 0.0).colwise().any();
      for (Eigen::Index c = 0; c < FieldColumn::count(); ++c)
      {
        if (any[c])
        {
          sums.there.push_back(c);
        }
      }
      const Eigen::MatrixXd columns = found.columns(Eigen::all, sums.there).transpose();
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

// Normal equations of every block, what noise allows, and where a gap lies by them.
#pragma once

#include "Kernels/Camera/CameraNoise.h"
#include "Kernels/Gap/Field/FieldColumns.h"
#include "Kernels/Gap/GapReport.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// The numbers of one block in one channel.
struct BlockSums
{
  // Weighted columns' products, fieldColumns().count^2; the last is the residual.
  Eigen::MatrixXd normal() const;
  // Of the weighted energy, where the columns change so.
  double energyLeft(const Eigen::VectorXd& change) const;
  // Those of ChannelColumns::there: all blocks in full are more than memory is fast for.
  std::vector<Eigen::Index> there;
  Eigen::MatrixXd products;
  double pixels = 0.0; // usable
  double energy = 0.0; // sum of squared residuals, plain
  double noise = 0.0;  // what noise allows of it
  double chance = 0.0; // and of the weighted energy
  double mean = 0.0;   // of the residual
  double level = 0.0;  // mean prediction
  // Half the mean squared difference of residuals that lie a few pixels apart, 0 where there are few: along x, along y.
  double difference = 0.0;
  double differenceDown = 0.0;
  double gradient = 0.0; // mean squared gradient of the prediction
  // A pixel's variance by the difference of the two halves of the block, as if noise were white; 0: nothing known.
  double halves = 0.0;
  // Without weights: ChannelColumns::ofNoise of the square of the derivative by blur, and of its product with the residual.
  double blurOfNoise = 0.0;
  double residualOfNoise = 0.0;
};

// How pixels are weighed, each of K channels: 1 / (noise variance + tolerance), less where a residual is beyond `limit`
// (Huber).
struct FieldWeights
{
  std::vector<CameraNoise> noise; // of both images
  Eigen::ArrayXd sceneNoise;      // of these a variance in the simulated image
  Eigen::ArrayXd tolerance;       // a variance: the forms are approximations
  Eigen::ArrayXd limit;
};

struct FieldStatistics
{
  FieldModel model;
  Eigen::Index channels = 0;
  std::vector<BlockSums> sums; // block after block, all channels together

  std::size_t blocks() const noexcept { return sums.size() / channels; }
  const BlockSums& at(std::size_t block, Eigen::Index channel) const
  {
    return sums[block * channels + channel];
  }
  // Sums of BlockSums::normal() over the blocks for which keep(block) is true, of each channel.
  template <typename Keep>
  std::vector<Eigen::MatrixXd> normals(const Keep& keep) const
  {
    std::vector<Eigen::MatrixXd> kept(
      channels, Eigen::MatrixXd::Zero(fieldColumns().count, fieldColumns().count));
    for (std::size_t b = 0; b < blocks(); ++b)
    {
      for (Eigen::Index k = 0; keep(b) && k < channels; ++k)
      {
        const BlockSums& block = at(b, k);
        kept[k](block.there, block.there) += block.products;
      }
    }
    return kept;
  }
  // Of each block a number of all its channels together.
  Eigen::VectorXd ofBlocks(double BlockSums::*number) const;
};

// Blur and stray light must not gain from taking away noise of the simulated image: the weighted products of derivatives and residual
// are without it, and the squares of the residual have as much of it as if nothing were blurred.
// weights: null: all pixels the same; the blur is asked for then. asked: for which steps, beside those that change something, there are columns.
FieldStatistics fieldStatistics(const FieldData& data, const FieldModel& model,
  const FieldWeights* weights, const AskedSteps& asked = everyStep());

// The same by normal matrices, of each channel, with a column of the gain.
Eigen::ArrayXd energiesBesideGain(const std::vector<Eigen::MatrixXd>& normals, bool ofChannels);

// The variance of noise in the simulated image, of each channel, 0 where it is not sure. In the mean over a block, the product of the
// residual and the derivative by blur is blur times the square of the latter; noise adds the same to it in every block, flat or not.
// Statistics: not weighted, with columns of gain, offset and blur.
Eigen::ArrayXd sceneNoise(const FieldStatistics& statistics);

// Weights that go by a model's residual. Statistics: as for sceneNoise().
FieldWeights fieldWeights(const FieldStatistics& statistics);

// Noise from differences of residuals three pixels apart, since neighbours share it in developed images (half of the block where it is
// smaller), in the smoother half of the blocks: a variance for each quarter of the levels (trimmed mean over blocks), then
// read^2 + shot^2 u.
std::vector<CameraNoise> fieldNoise(const FieldStatistics& statistics);

// Of a channel: by how much means within blocks scatter more than with white noise (variances), at least 1. Statistics: weighted.
double noiseCoherence(const FieldStatistics& statistics, Eigen::Index channel);

// Axes and their bases on the pixels of a block:
//
//   channel        an offset and a gain of each channel
//   level          u and u^2, common to all channels
//   position       u times a quadratic in x and y, for each channel
//   edges          derivatives of the image by displacement and blur, the surround minus u, for each channel
//   rows, columns  stripes, where a period was found
//   sample         (with labels) a mean of its own for each label and channel: what the others leave of it
//   region         (without labels) means of blocks: what the others leave
// Fitted on the training blocks; the shares are Shapley values of the R^2 on the test blocks, of the energy beyond
// noise. A common gain is level's.
// after: null, or a model whose displacements and blurs are on the axis of edges as they are, however large.
std::vector<GapAxis> fieldAxes(
  const FieldData& data, const FieldStatistics& statistics, const FieldModel* after = nullptr);

} // namespace msi

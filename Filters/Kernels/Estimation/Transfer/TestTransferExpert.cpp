#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/SampleDraw.h"
#include "Kernels/Estimation/Transfer/TransferBlocks.h"
#include "Kernels/Estimation/Transfer/TransferExpert.h"
#include "Kernels/Estimation/Transfer/TransferObjective.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using msi::TransferKernel;
using msi::TransferSpace;
using msi::test::largestDifference;
using msi::test::randomMatrix;

constexpr TransferSpace BothSpaces[] = { TransferSpace::Linear, TransferSpace::SquareRoot };

Eigen::MatrixXd positive(Eigen::Index rows, Eigen::Index columns, unsigned seed)
{
  return (0.45 + 0.4 * randomMatrix(rows, columns, seed).array()).matrix();
}

TransferKernel someKernel()
{
  TransferKernel kernel{ Eigen::VectorXd(TransferKernel::Count) };
  kernel.logarithms << -0.3, 0.4, -1.0, -0.2, -3.0, -2.0, -2.5, -4.0, -3.5;
  return kernel;
}

TEST(TransferKernel, IsTheStatedFunction)
{
  const TransferKernel kernel = someKernel();
  const Eigen::MatrixXd a = randomMatrix(4, 5, 1);
  const Eigen::MatrixXd b = randomMatrix(4, 6, 2);
  const Eigen::MatrixXd k = msi::covariance(kernel, a, 2, b, 3);
  for (Eigen::Index i = 0; i < 5; ++i)
  {
    for (Eigen::Index j = 0; j < 6; ++j)
    {
      const double both = i >= 2 && j >= 3 ? 1.0 : 0.0;
      const double product = a.col(i).dot(b.col(j)) / 4.0;
      const double distance = (a.col(i) - b.col(j)).squaredNorm() / 4.0;
      const double expected = std::exp(-0.3) + both * std::exp(-3.0) +
        (std::exp(0.4) + both * std::exp(-2.0)) * product +
        (std::exp(-1.0) + both * std::exp(-2.5)) * std::exp(-0.5 * distance * std::exp(2.0 * 0.2));
      EXPECT_NEAR(k(i, j), expected, 1e-13);
    }
  }
}

// One sample again and again: what differs is rounding, which must not become the unit of the features.
TEST(TransferFeatures, OfOneRepeatedSampleAreNotBlownUp)
{
  Eigen::MatrixXd chart = Eigen::MatrixXd::Constant(4, 30, 0.1);
  chart(1, 2) = std::nextafter(0.1, 1.0);
  for (const TransferSpace space : BothSpaces)
  {
    const auto features = msi::featuresOf(space, chart);
    EXPECT_LT(features.ofTarget(1.1 * chart).cwiseAbs().maxCoeff(), 1.0);
  }
}

TEST(TransferFeatures, UndoGainAndOffsetOfTheTarget)
{
  const Eigen::MatrixXd chart = positive(3, 20, 3);
  for (const TransferSpace space : BothSpaces)
  {
    auto features = msi::featuresOf(space, chart);
    features.logGain << 0.1, -0.2, 0.05;
    features.offset << 0.02, 0.0, -0.01;
    const Eigen::MatrixXd seen = (-features.logGain.array()).exp().matrix().asDiagonal() *
      (chart.colwise() - features.responseScale * features.offset);
    EXPECT_LT(largestDifference(features.ofTarget(seen), features.ofChart(chart)), 1e-13);
    EXPECT_NEAR(features.ofChart(chart).mean(), 0.0, 1e-13);
  }
}

TEST(TransferObjective, HasTheGradientOfItsValue)
{
  for (const TransferSpace space : BothSpaces)
  {
    const Eigen::MatrixXd chart = positive(4, 25, 4);
    msi::TransferObjective objective(
      msi::featuresOf(space, chart), chart, positive(4, 7, 5), randomMatrix(32, 6, 6));
    const Eigen::VectorXd at =
      objective.start() + 0.5 * randomMatrix(objective.start().size(), 1, 7);
    Eigen::VectorXd gradient;
    Eigen::VectorXd unused;
    objective(at, gradient);
    for (Eigen::Index i = 0; i < at.size(); ++i)
    {
      constexpr double step = 1e-5;
      Eigen::VectorXd up = at;
      Eigen::VectorXd down = at;
      up[i] += step;
      down[i] -= step;
      const double slope = (objective(up, unused) - objective(down, unused)) / (2.0 * step);
      EXPECT_NEAR(gradient[i], slope, 1e-6 * (1.0 + std::abs(slope))) << "element " << i;
    }
  }
}

// The textbook's Gaussian process on the whole matrix (Rasmussen and Williams, Eqs. 2.25 and 2.26),
// for outputs in the expert's space.
struct WholeMatrix
{
  Eigen::MatrixXd mean;     // bands x pixels
  Eigen::VectorXd variance; // with noise
};

WholeMatrix wholeMatrix(const TransferKernel& kernel, const msi::TransferFeatures& features,
  const msi::SampleSet& chart, const msi::SampleSet& tuning, const Eigen::VectorXd& center,
  const Eigen::MatrixXd& at, double noiseAt, bool atTarget)
{
  const msi::SampleSet both = msi::joined(chart, tuning);
  Eigen::MatrixXd x(chart.channels(), both.size());
  x << features.ofChart(chart.response), features.ofTarget(tuning.response);
  Eigen::MatrixXd k = msi::covariance(kernel, x, chart.size(), x, chart.size());
  k.diagonal().head(chart.size()).array() += kernel[TransferKernel::ChartNoise];
  k.diagonal().tail(tuning.size()).array() += kernel[TransferKernel::TargetNoise];
  const Eigen::MatrixXd z = atTarget ? features.ofTarget(at) : features.ofChart(at);
  const Eigen::Index chartAt = atTarget ? 0 : z.cols();
  const Eigen::MatrixXd cross = msi::covariance(kernel, z, chartAt, x, chart.size());
  const Eigen::MatrixXd outputs =
    both.reflectance.unaryExpr([&](double r) { return msi::toSpace(features.space, r); });
  const Eigen::MatrixXd inverse = k.inverse();
  WholeMatrix result;
  result.mean =
    ((cross * inverse * (outputs.colwise() - center).transpose()).transpose()).colwise() + center;
  result.variance =
    (msi::covariance(kernel, z, chartAt, z, chartAt) - cross * inverse * cross.transpose())
      .diagonal()
      .array() +
    noiseAt;
  return result;
}

struct PosteriorCase
{
  explicit PosteriorCase(TransferSpace space)
    : features(msi::featuresOf(space, chart.response))
  {
    features.logGain = 0.1 * randomMatrix(3, 1, 8);
    features.offset = 0.05 * randomMatrix(3, 1, 9);
    fit = msi::transferPosterior(kernel, features, chart, tuning, center);
  }
  TransferKernel kernel = someKernel();
  msi::SampleSet chart{ positive(5, 14, 10), positive(3, 14, 11) };
  msi::SampleSet tuning{ positive(5, 6, 12), positive(3, 6, 13) };
  Eigen::VectorXd center = randomMatrix(5, 1, 14);
  msi::TransferFeatures features;
  msi::TransferExpertFit fit;
};

// The points leave a hundredth of the noise unexplained at most; these twenty samples are few enough
// for the difference to stay small.
constexpr double PointTolerance = 2e-3;

TEST(TransferExpert, PredictsAsTheWholeMatrixDoes)
{
  for (const TransferSpace space : BothSpaces)
  {
    const PosteriorCase example(space);
    const Eigen::MatrixXd at = positive(3, 11, 15);
    const WholeMatrix expected = wholeMatrix(example.kernel, example.features, example.chart,
      example.tuning, example.center, at, example.kernel[TransferKernel::TargetNoise], true);
    Eigen::MatrixXd mean(5, 11);
    Eigen::MatrixXd deviation(5, 11);
    const msi::PackedTransfer mixture({ { example.fit.expert }, { 1.0 }, { 1.0 },
      Eigen::MatrixXd::Zero(5, 4), 0.0, Eigen::VectorXd::Ones(5) });
    msi::runTransfer(mixture, at.data(), mean.data(), deviation.data(), 11);
    const Eigen::MatrixXd reflectance =
      expected.mean.unaryExpr([&](double y) { return msi::fromSpace(space, y); });
    EXPECT_LT(largestDifference(mean, reflectance), PointTolerance);
    for (Eigen::Index n = 0; n < 5; ++n)
    {
      for (Eigen::Index p = 0; p < 11; ++p)
      {
        const double slope = msi::slopeFromSpace(space, reflectance(n, p));
        EXPECT_NEAR(deviation(n, p), slope * std::sqrt(expected.variance[p]), PointTolerance);
      }
    }
  }
}

TEST(TransferExpert, LeavesOutASampleAsARefitWithoutItDoes)
{
  for (const TransferSpace space : BothSpaces)
  {
    const PosteriorCase example(space);
    for (Eigen::Index left = 0; left < 20; ++left)
    {
      const bool ofTarget = left >= 14;
      const auto without =
        msi::remainingSamples(ofTarget ? 6 : 14, { ofTarget ? left - 14 : left });
      const auto chart = ofTarget ? example.chart : example.chart.subset(without);
      const auto tuning = ofTarget ? example.tuning.subset(without) : example.tuning;
      const Eigen::MatrixXd at =
        ofTarget ? example.tuning.response.col(left - 14) : example.chart.response.col(left);
      const double noise =
        example.kernel[ofTarget ? TransferKernel::TargetNoise : TransferKernel::ChartNoise];
      const WholeMatrix expected = wholeMatrix(
        example.kernel, example.features, chart, tuning, example.center, at, noise, ofTarget);
      const Eigen::MatrixXd reflectance =
        expected.mean.unaryExpr([&](double y) { return msi::fromSpace(space, y); });
      EXPECT_LT(
        largestDifference(example.fit.leftOutEstimate.col(left), reflectance), PointTolerance);
      EXPECT_NEAR(example.fit.leftOutVariance[left] / expected.variance[0], 1.0, 0.01);
    }
  }
}

// Responses of three channels to reflectances that are linear in them, and a little more.
msi::SampleSet nearlyLinearSamples(Eigen::Index count, unsigned seed, double gain)
{
  const Eigen::MatrixXd base = positive(3, count, seed);
  return { positive(5, 3, 16) / 3.0 * base + 0.01 * randomMatrix(5, count, seed + 1), gain * base };
}

// A fit that never sees the sample starts from the prior's center and subtracts a mean of its own, but finds the same
// hyperparameters to within the tolerance of the search.
TEST(TransferExpert, RefitsWithoutTheSampleItEstimates)
{
  const msi::SampleSet chart = nearlyLinearSamples(30, 17, 1.0);
  const msi::SampleSet tuning = nearlyLinearSamples(6, 19, 1.05);
  for (const TransferSpace space : BothSpaces)
  {
    const auto fit = msi::fitTransferExpert(space, chart, tuning);
    for (Eigen::Index left = 0; left < 6; ++left)
    {
      const auto without =
        msi::fitTransferExpert(space, chart, tuning.subset(msi::remainingSamples(6, { left })));
      const Eigen::MatrixXd at = tuning.response.col(left);
      Eigen::VectorXd mean(5);
      Eigen::VectorXd deviation(5);
      const msi::PackedTransfer mixture({ { without.expert }, { 1.0 }, { 1.0 },
        Eigen::MatrixXd::Zero(5, 4), 0.0, Eigen::VectorXd::Ones(5) });
      msi::runTransfer(mixture, at.data(), mean.data(), deviation.data(), 1);
      EXPECT_LT(largestDifference(fit.refittedEstimate.col(left), mean), 0.0005) << left;
    }
  }
}

}

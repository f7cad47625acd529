#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/MethodComparison.h"
#include "Kernels/Numerics/AffineTransform.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using msi::test::messageOf;
using msi::test::randomMatrix;

msi::SampleSet affineSamples(Eigen::Index count, unsigned seed)
{
  const Eigen::MatrixXd responses = randomMatrix(3, count, seed);
  return { msi::AffineTransform(randomMatrix(6, 4, 99))(responses), responses };
}

TEST(MethodComparison, HoldsOutWhatItDoesNotTuneOn)
{
  msi::ComparisonOptions options;
  options.methods = { "pooled", "direct" };
  options.tuningSamples = 5;
  const msi::MethodComparison comparison(affineSamples(20, 1), affineSamples(12, 2), options);
  const auto draw = comparison.run(3);
  EXPECT_EQ(draw.tuning, msi::drawSamples(12, 5, 1, 3));
  EXPECT_EQ(draw.heldOut, msi::remainingSamples(12, draw.tuning));
  ASSERT_EQ(draw.estimates.size(), 2U);
  EXPECT_EQ(draw.estimates[0].method, "pooled");
  for (const auto& estimate : draw.estimates)
  {
    ASSERT_EQ(estimate.rms.size(), 7);
    EXPECT_LT(estimate.rms.maxCoeff(), 1e-13);
  }
}

TEST(MethodComparison, RmsIsTheRootMeanSquareOverBands)
{
  // Chart: r = 1 whatever u; target: s = (1 + 3, 1 + 4), so every rms is sqrt((9 + 16) / 2).
  const Eigen::MatrixXd responses = randomMatrix(1, 9, 3);
  const msi::SampleSet chart{ Eigen::MatrixXd::Ones(2, 9), responses };
  msi::SampleSet target = chart;
  target.reflectance.colwise() += Eigen::Vector2d(3.0, 4.0);
  msi::ComparisonOptions options;
  options.methods = { "direct" };
  options.tuningSamples = 4;
  const auto draw = msi::MethodComparison(chart, target, options).run(0);
  EXPECT_NEAR(draw.estimates[0].rms.minCoeff(), std::sqrt(12.5), 1e-12);
  EXPECT_NEAR(draw.estimates[0].rms.maxCoeff(), std::sqrt(12.5), 1e-12);
}

TEST(MethodComparison, OwnMediumIsLeastSquaresOnTheTargetItself)
{
  // The target is affine in its responses, and the chart is not: only the target's own samples tell.
  msi::SampleSet chart = affineSamples(20, 1);
  chart.reflectance.setRandom();
  msi::ComparisonOptions options;
  options.tuningSamples = 3;
  const auto own = msi::MethodComparison(chart, affineSamples(13, 2), options).ownMedium();
  EXPECT_EQ(own.failure, "");
  ASSERT_EQ(own.rms.size(), 13);
  EXPECT_LT(own.rms.maxCoeff(), 1e-12);
  const auto few = msi::MethodComparison(chart, affineSamples(4, 2), options).ownMedium();
  EXPECT_EQ(few.failure,
    "nine tenths of the target are 3 samples for 4 unknowns per band; expected at least 4 samples");
}

TEST(MethodComparison, SaysWhichMethodCannotRunAndRunsTheOthers)
{
  msi::ComparisonOptions options;
  options.methods = { "r-model", "direct" };
  options.tuningSamples = 3;
  const auto draw =
    msi::MethodComparison(affineSamples(20, 1), affineSamples(12, 2), options).run(0);
  ASSERT_EQ(draw.estimates.size(), 2U);
  EXPECT_EQ(draw.estimates[0].failure,
    "the R-model has 3 tuning samples for 4 unknowns a band; expected at least 4 samples");
  EXPECT_EQ(draw.estimates[0].reflectance.size(), 0);
  EXPECT_EQ(draw.estimates[1].failure, "");
  EXPECT_EQ(draw.estimates[1].reflectance.cols(), 9);
}

TEST(MethodComparison, RefusesBadInputAndSaysWhy)
{
  const auto samples = affineSamples(12, 4);
  const auto compare = [&](const msi::ComparisonOptions& options)
  { return messageOf([&] { msi::MethodComparison(samples, samples, options).run(0); }); };
  msi::ComparisonOptions options;
  options.tuningSamples = 12;
  EXPECT_EQ(compare(options),
    "12 tuning samples are asked for and the target has 12 samples; "
    "expected a number from 1 to 11, so that samples are left to test on");
  options.tuningSamples = 3;
  options.methods = { "magic" };
  EXPECT_EQ(compare(options).substr(0, 37), "there is no estimation method 'magic'");
  options.methods.clear();
  EXPECT_EQ(compare(options), "no estimation method is asked for; expected at least one");
}

}

#include "Kernels/Difference/ErrorSummary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{

Eigen::VectorXd sample()
{
  Eigen::VectorXd values(11);
  values << 0.5, 0.125, 3.75, 1.0, 0.3, 2.2, 0.0, 7.9, 0.61, 1.45, 0.02;
  return values;
}

// Expected values by numpy 1.24: mean, std, median, percentile.
TEST(ErrorSummary, MatchesNumpy)
{
  const msi::ErrorSummary got = msi::summarize(sample());
  EXPECT_EQ(got.count, 11);
  EXPECT_EQ(got.nonFinite, 0);
  EXPECT_DOUBLE_EQ(got.mean, 1.6231818181818183);
  EXPECT_DOUBLE_EQ(got.standardDeviation, 2.259549706475398);
  EXPECT_EQ(got.median, 0.61);
  EXPECT_DOUBLE_EQ(got.p95, 5.825);
  EXPECT_EQ(got.max, 7.9);
  EXPECT_DOUBLE_EQ(msi::percentile(sample(), 12.5), 0.04625);
  EXPECT_DOUBLE_EQ(msi::percentile(sample(), 99.0), 7.485);
  EXPECT_EQ(msi::percentile(sample(), 0.0), 0.0);
  EXPECT_EQ(msi::percentile(sample(), 100.0), 7.9);
}

TEST(ErrorSummary, TheMedianOfAnEvenNumberIsTheMeanOfTheMiddleTwo)
{
  EXPECT_EQ(msi::summarize(Eigen::Vector4d(4.0, 1.0, 2.0, 10.0)).median, 3.0);
}

TEST(ErrorSummary, NonFiniteValuesAreCountedAndLeftOut)
{
  Eigen::VectorXd values(13);
  values << sample(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::infinity();
  const msi::ErrorSummary got = msi::summarize(values);
  const msi::ErrorSummary clean = msi::summarize(sample());
  EXPECT_EQ(got.nonFinite, 2);
  EXPECT_EQ(got.count, 11);
  EXPECT_EQ(got.mean, clean.mean);
  EXPECT_EQ(got.max, clean.max);
  EXPECT_TRUE(std::isnan(msi::summarize(Eigen::VectorXd()).mean));
  EXPECT_TRUE(std::isnan(msi::percentile(sample(), 101.0)));
}

TEST(ErrorSummary, TheOrderOfTheValuesMakesNoDifference)
{
  std::mt19937_64 random(3);
  std::lognormal_distribution<double> distribution(0.0, 2.0);
  Eigen::VectorXd values(1000);
  for (double& value : values)
  {
    value = distribution(random);
  }
  const msi::ErrorSummary before = msi::summarize(values);
  std::shuffle(values.begin(), values.end(), random);
  const msi::ErrorSummary after = msi::summarize(values);
  EXPECT_EQ(after.mean, before.mean);
  EXPECT_EQ(after.standardDeviation, before.standardDeviation);
}

}

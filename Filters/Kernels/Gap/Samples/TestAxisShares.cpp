#include "Kernels/Gap/Samples/GapEvidence.h"

#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{

using namespace msi::test;

// A capture without noise whose gap is given in numbers.
class AxisSharesOfGap : public ::testing::Test
{
protected:
  msi::GapData Data = dataOf(captureOf(rasterSamples(128), {}, 1, 1e-5));

  msi::AxisShares share(const std::function<double(Eigen::Index, Eigen::Index)>& gap)
  {
    Eigen::MatrixXd values(Data.channels(), Data.samples());
    for (Eigen::Index i = 0; i < Data.samples(); ++i)
    {
      for (Eigen::Index k = 0; k < Data.channels(); ++k)
      {
        values(k, i) = gap(k, i);
      }
    }
    Gap = values;
    return msi::shareOverAxes(Data, values);
  }
  Eigen::MatrixXd Gap;
};

TEST_F(AxisSharesOfGap, OffsetsThatDifferByChannelAreTheChannels)
{
  const auto shares = share([](Eigen::Index k, Eigen::Index) { return k % 2 == 0 ? 0.01 : -0.01; });
  EXPECT_EQ(shares.axes.front().axis, "channel");
  EXPECT_GT(shares.axes.front().share, 0.9);
  EXPECT_NEAR(shares.predictable, Gap.squaredNorm(), 0.01 * Gap.squaredNorm());
}

TEST_F(AxisSharesOfGap, OneWorstChannelIsNamedWithItsShare)
{
  const auto shares = share([](Eigen::Index k, Eigen::Index) { return k == 3 ? 0.02 : 0.0; });
  ASSERT_EQ(shares.axes.front().axis, "channel");
  EXPECT_EQ(shares.axes.front().worst.front().cell, "550nm");
  EXPECT_DOUBLE_EQ(shares.axes.front().worst.front().share, 1.0);
}

TEST_F(AxisSharesOfGap, CommonGainIsLevelsAndOfOneMediumTheMediums)
{
  const auto level =
    share([this](Eigen::Index k, Eigen::Index i) { return 0.05 * Data.simulated(k, i); });
  EXPECT_EQ(level.axes.front().axis, "level");
  const auto medium = share(
    [this](Eigen::Index k, Eigen::Index i)
    {
      return Data.scene.medium()[static_cast<std::size_t>(i)] == 1 ? 0.05 * Data.simulated(k, i)
                                                                   : 0.0;
    });
  EXPECT_EQ(medium.axes.front().axis, "medium");
  ASSERT_FALSE(medium.axes.front().worst.empty());
  EXPECT_EQ(medium.axes.front().worst.front().cell, "fabric");
  EXPECT_DOUBLE_EQ(medium.axes.front().worst.front().share, 1.0);
}

TEST_F(AxisSharesOfGap, SlopeOverTheFieldIsPositions)
{
  const auto shares = share([this](Eigen::Index k, Eigen::Index i)
    { return 0.05 * Data.scene.fieldX()[i] * Data.simulated(k, i); });
  EXPECT_EQ(shares.axes.front().axis, "position");
  EXPECT_NEAR(shares.predictable, Gap.squaredNorm(), 0.01 * Gap.squaredNorm());
}

// Offsets of the channels with energy 1 and offsets of single samples with energy 3, independent of each other:
// a quarter and three quarters.
TEST_F(AxisSharesOfGap, IndependentPartsShareByTheirEnergy)
{
  const msi::CounterRandom random(9);
  const auto shares = share(
    [&](Eigen::Index k, Eigen::Index i)
    {
      const bool up = random.uniform(static_cast<std::uint64_t>(i)) < 0.5;
      const double channel = (static_cast<double>(k) - 3.0) / 2.0; // mean square 1
      return 0.01 * channel + std::sqrt(3.0) * (up ? 0.01 : -0.01);
    });
  ASSERT_GE(shares.axes.size(), 2U);
  EXPECT_EQ(shares.axes[0].axis, "sample");
  EXPECT_NEAR(shares.axes[0].share, 0.75, 0.08);
  EXPECT_EQ(shares.axes[1].axis, "channel");
  EXPECT_NEAR(shares.axes[1].share, 0.25, 0.08);
}

TEST_F(AxisSharesOfGap, SharesAreOfTheWholeAndSorted)
{
  const auto shares = share(
    [this](Eigen::Index k, Eigen::Index i)
    {
      return 0.02 * Data.simulated(k, i) +
        (Data.scene.medium()[static_cast<std::size_t>(i)] == 1 ? 0.01 : 0.0);
    });
  double sum = 0.0;
  double last = 1.0;
  for (const msi::GapAxis& axis : shares.axes)
  {
    EXPECT_LE(axis.share, last);
    last = axis.share;
    sum += axis.share;
  }
  EXPECT_LE(sum, 1.0 + 1e-12);
  EXPECT_GT(sum, 0.95);
}

// A gain of its own for every sample, the same in all of its channels: no other axis knows anything of it.
TEST_F(AxisSharesOfGap, WhatGoesWithSingleSamplesIsTheSamples)
{
  const msi::CounterRandom random(9);
  const auto shares = share([&](Eigen::Index, Eigen::Index i)
    { return random.uniform(static_cast<std::uint64_t>(i)) < 0.5 ? 0.01 : -0.01; });
  EXPECT_EQ(shares.axes.front().axis, "sample");
  EXPECT_GT(shares.axes.front().share, 0.8);
  EXPECT_LT(shares.predictable, 0.1 * Gap.squaredNorm());
}

} // namespace

#include "Kernels/Gap/GapProfile.h"
#include "Kernels/Gap/ReportParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

msi::SceneSamples tenSamples()
{
  msi::SceneSamples samples;
  samples.reflectance = Eigen::RowVectorXd::LinSpaced(10, 0.1, 1.0).replicate(3, 1);
  samples.medium = { "a", "b", "a", "b", "a", "b", "a", "b", "a", "b" };
  samples.scene = std::vector<std::string>(10, "one");
  samples.order = Eigen::VectorXd::LinSpaced(10, 10.0, 1.0);
  return samples;
}

TEST(GapProfile, GroupsByWhatDiffers)
{
  const auto groups = msi::groupSamples(tenSamples());
  ASSERT_EQ(groups.size(), 2u + 5u + 5u); // one scene and no position make no group
  EXPECT_EQ(groups[0].name, "a");
  EXPECT_EQ(groups[0].samples, (std::vector<Eigen::Index>{ 0, 2, 4, 6, 8 }));
  EXPECT_EQ(groups[2].name, "reflectance 0.1..0.2");
  EXPECT_EQ(groups[2].samples, (std::vector<Eigen::Index>{ 0, 1 }));
  EXPECT_EQ(groups[7].name, "order 1..2");
  EXPECT_EQ(groups[7].samples, (std::vector<Eigen::Index>{ 9, 8 }));
}

TEST(GapProfile, PlacesTheSamplesInThirdsOfTheField)
{
  msi::SceneSamples samples;
  samples.reflectance = Eigen::MatrixXd::Constant(2, 4, 0.5);
  samples.x = Eigen::Vector4d(0.0, 3.0, 0.0, 3.0);
  samples.y = Eigen::Vector4d(0.0, 0.0, 3.0, 3.0);
  const auto groups = msi::groupSamples(samples);
  ASSERT_EQ(groups.size(), 4u); // the corners; equal reflectances make no group
  EXPECT_EQ(groups[0].name, "x 0..1, y 0..1");
  EXPECT_EQ(groups[3].name, "x 2..3, y 2..3");
  EXPECT_EQ(groups[3].samples, (std::vector<Eigen::Index>{ 3 }));
}

TEST(GapProfile, MeanAndRmsLeaveOutWhatWasNotMeasured)
{
  Eigen::MatrixXd gap(2, 3);
  gap << 3.0, -1.0, NaN, NaN, NaN, NaN;
  const auto grouped = msi::groupGap(gap, { { "medium", "a", { 0, 1, 2 } } });
  EXPECT_EQ(grouped.mean(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(grouped.rms(0, 0), std::sqrt(5.0));
  EXPECT_TRUE(std::isnan(grouped.mean(1, 0)));
  EXPECT_TRUE(std::isnan(grouped.rms(1, 0)));
}

TEST(GapProfile, RelativeGapOfAGainIsTheGain)
{
  Eigen::MatrixXd simulated(2, 2);
  simulated << 0.2, 0.8, 0.6, 0.4;
  Eigen::MatrixXd gap = 0.05 * simulated;
  EXPECT_NEAR(msi::relativeGap(gap, simulated)[0], 0.05, 1e-15);
  gap(0, 1) = NaN;
  EXPECT_NEAR(msi::relativeGap(gap, simulated)[1], 0.05, 1e-15);
  gap.col(0).setConstant(NaN);
  EXPECT_TRUE(std::isnan(msi::relativeGap(gap, simulated)[0]));
}

TEST(GapProfile, TrendIsSortedAndItsLevelStepsAtChangePoints)
{
  const auto samples = tenSamples();
  const Eigen::MatrixXd simulated = Eigen::MatrixXd::Ones(1, 10);
  msi::GapReport report;
  // Order 1..4: a gap of 0.1; order 5..10: 0.3.
  report.gapBefore.resize(1, 10);
  report.gapBefore << 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.1, 0.1, 0.1, 0.1;
  report.gapAfter = Eigen::MatrixXd::Zero(1, 10);
  report.gapBefore(0, 9) = NaN; // order 1 was not measured
  report.changePoints = { { 4.5, 0.2, 10.0 } };
  const auto trend = msi::trendOf(samples, report, simulated);
  ASSERT_EQ(trend.sample.size(), 9u);
  EXPECT_EQ(trend.order, Eigen::VectorXd::LinSpaced(9, 2.0, 10.0));
  EXPECT_EQ(trend.sample.front(), 8);
  EXPECT_EQ(trend.level.head(3), Eigen::Vector3d::Constant(0.1));
  EXPECT_EQ(trend.level.tail(6), Eigen::VectorXd::Constant(6, 0.3));
}

TEST(GapProfile, TheLevelOfADriftIsALineThatOutliersDoNotPull)
{
  auto samples = tenSamples();
  samples.order = Eigen::VectorXd::LinSpaced(10, 1.0, 10.0);
  msi::GapReport report;
  report.gapBefore = 0.01 * samples.order.transpose();
  report.gapBefore(0, 1) = -3.0;
  report.gapBefore(0, 7) = 5.0;
  report.gapAfter = Eigen::MatrixXd::Zero(1, 10);
  const auto trend = msi::trendOf(samples, report, Eigen::MatrixXd::Ones(1, 10));
  EXPECT_LT((trend.level - 0.01 * trend.order).cwiseAbs().maxCoeff(), 0.02);
}

TEST(GapProfile, NoOrderNoTrend)
{
  auto samples = tenSamples();
  samples.order.resize(0);
  msi::GapReport report;
  report.gapBefore = report.gapAfter = Eigen::MatrixXd::Zero(1, 10);
  EXPECT_TRUE(msi::trendOf(samples, report, Eigen::MatrixXd::Ones(1, 10)).sample.empty());
}

TEST(ShrinkInterval, IsAPointWhereAllSamplesAreAlike)
{
  // before 4, after 1, noise 0 in each sample: shrink 1 - sqrt(1 / 4).
  const msi::GroupEnergies energies = Eigen::RowVector3d(4.0, 1.0, 0.0).replicate(20, 1);
  const auto interval = msi::shrinkInterval(energies, 1);
  EXPECT_DOUBLE_EQ(interval[0], 0.5);
  EXPECT_DOUBLE_EQ(interval[1], 0.5);
}

TEST(ShrinkInterval, WidensWithTheSpreadOfTheSamples)
{
  Eigen::Matrix<double, 2, 3> two;
  two << 4.0, 0.0, 0.0, 4.0, 2.0, 0.0;
  const auto interval = msi::shrinkInterval(two.replicate(20, 1), 1);
  // The mean of 40 draws of 0 or 2 has a standard deviation of 1 / sqrt(40).
  const double spread = 1.96 / std::sqrt(40.0);
  EXPECT_NEAR(interval[0], 1.0 - std::sqrt((1.0 + spread) / 4.0), 0.03);
  EXPECT_NEAR(interval[1], 1.0 - std::sqrt((1.0 - spread) / 4.0), 0.03);
}

TEST(ShrinkInterval, NothingFromNothing)
{
  EXPECT_EQ(msi::shrinkInterval(msi::GroupEnergies(0, 3), 1), (std::array<double, 2>{ 0.0, 0.0 }));
}
}

#include "Kernels/Gap/ExcessScatter.h"
#include "Kernels/Gap/GapTestData.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using namespace msi::test;

constexpr double ModelNoise = 0.0005;

// One reading a sample with `noise`, its standard deviation given as ModelNoise.
msi::GapCapture understated(double noise, Eigen::Index samples = 96)
{
  msi::GapCapture capture = captureOf(rasterSamples(samples), {}, 1, noise);
  capture.noise = msi::ReadingNoise{ ModelNoise, 0.0 };
  return capture;
}

double factorOf(const msi::GapCapture& capture)
{
  const msi::GapData data = dataOf(capture);
  return msi::excessScatter(data, data.observed - data.simulated, *capture.noise,
    Eigen::MatrixXd::Zero(data.channels(), data.samples()));
}

// 672 readings: the standard error of the factor is 2.7 %.
TEST(ExcessScatter, FindsTheFactorOfAnUnderstatedNoise)
{
  EXPECT_NEAR(factorOf(understated(2.0 * ModelNoise)), 2.0, 0.2);
  EXPECT_EQ(factorOf(understated(ModelNoise)), 1.0);
}

// The error of a reflectance is the same in all channels that see its wavelength.
TEST(ExcessScatter, ReflectancesThatScatterAreNotNoise)
{
  msi::GapCapture capture = understated(ModelNoise);
  std::mt19937_64 random(3);
  std::normal_distribution<double> error(0.0, 0.006);
  for (double& value : capture.samples.reflectance.reshaped())
  {
    value += error(random);
  }
  EXPECT_EQ(factorOf(capture), 1.0);
}

TEST(ExcessScatter, WhatChannelsShareIsNotNoise)
{
  msi::GapCapture capture = understated(ModelNoise);
  std::mt19937_64 random(3);
  std::normal_distribution<double> error(0.0, 2.0 * ModelNoise);
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    capture.readings.col(j).array() += error(random);
  }
  EXPECT_EQ(factorOf(capture), 1.0);
}

TEST(ExcessScatter, WithoutRepeatsItIsNamedAndOnlyHalfBelieved)
{
  const msi::GapReport report = diagnosisOf(understated(3.0 * ModelNoise, 192));
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "excess_noise");
  EXPECT_NEAR(report.causes.front().parameters.front().value, 3.0, 0.3);
  EXPECT_LT(report.causes.front().share, 0.5);
  EXPECT_EQ(report.verdict, msi::GapVerdict::PartlyExplained);
  EXPECT_NEAR(report.causes.front().share + report.unexplained.share, 1.0, 1e-9);
  EXPECT_TRUE(says(report.notes, "A second reading of each would tell"));
}

} // namespace

#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Gap/Samples/ResidualScatter.h"

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
  return msi::excessScatter(data, data.observed - data.simulated, data.variance,
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
  EXPECT_LT(report.causes.front().probability, 0.5);
  EXPECT_EQ(report.verdict, msi::GapVerdict::PartlyExplained);
  EXPECT_TRUE(says(report.notes, "A second reading of each would tell"));
}

double scatterOf(const msi::GapCapture& capture)
{
  const msi::GapData data = dataOf(capture);
  const Eigen::MatrixXd residual = data.observed - data.simulated;
  return msi::reflectanceScatter(data, residual, residual.squaredNorm());
}

TEST(ReflectanceScatter, IsThatOfTheMeasurement)
{
  msi::GapCapture capture = captureWith({}, 400);
  EXPECT_LT(scatterOf(capture), 0.0003);
  std::mt19937_64 random(4);
  std::normal_distribution<double> error(0.0, 0.002);
  for (double& value : capture.samples.reflectance.reshaped())
  {
    value += error(random);
  }
  // Five medians of 400 differences each, 4 % apart by chance.
  EXPECT_NEAR(scatterOf(capture), 0.002, 0.0003);
}

// Exposure, or a few readings that are wrong altogether, are no scatter of the reflectances.
TEST(ReflectanceScatter, ErrorsOfTheModelAreNone)
{
  // All that stands out would be the largest that is allowed, 0.003.
  EXPECT_LT(scatterOf(captureWith({ { "exposure_gain", "", "", { 1.02 } } }, 400)), 0.002);
  msi::GapCapture capture = captureWith({}, 400);
  for (Eigen::Index j = 0; j < 60; ++j)
  {
    capture.readings(j % 7, j * 7) += 0.05;
  }
  EXPECT_LT(scatterOf(capture), 0.0006);
}

} // namespace

#include "Kernels/Gap/Samples/GapNoise.h"
#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace
{

using namespace msi::test;

// Welford's averages by hand: readings 0.2 and 0.4 give mean 0.3 and squared deviations 0.02.
TEST(GapData, AveragesRepeatsAndLeavesOutWhatWasNotMeasured)
{
  msi::GapCapture capture = captureOf(rasterSamples(8), {}, 2);
  capture.readings(0, 0) = 0.2;
  capture.readings(0, 1) = 0.4;
  capture.readings(1, 0) = std::numeric_limits<double>::quiet_NaN();
  capture.readings.col(2).setConstant(std::numeric_limits<double>::quiet_NaN());
  capture.readings.col(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  capture.samples.reflectance(5, 3) = std::numeric_limits<double>::quiet_NaN();
  const msi::GapData data = msi::prepareGapData(capture, {});
  EXPECT_NEAR(data.observed(0, 0), 0.3, 1e-15);
  EXPECT_NEAR(data.scatter(0, 0), 0.02, 1e-15);
  EXPECT_EQ(data.count(1, 0), 1.0);
  EXPECT_EQ(data.usable, (msi::SampleList{ 0, 2, 4, 5, 6, 7 }));
  EXPECT_EQ(msi::samplesOutside(data, 0).size() + data.folds[0].size(), data.usable.size());
  EXPECT_EQ(data.elements, 6 * 7);
}

TEST(GapNoise, MeansOfRepeatsScatterLessByTheirNumber)
{
  const msi::GapData data = msi::prepareGapData(captureOf(rasterSamples(8), {}, 4), {});
  const msi::CameraNoise noise{ 0.002, 0.01 };
  const Eigen::MatrixXd variance = msi::readingVariance(data, noise);
  for (Eigen::Index i = 0; i < variance.size(); ++i)
  {
    EXPECT_NEAR(variance(i), (4e-6 + 1e-4 * data.observed(i)) / 4.0, 2e-12);
  }
}

// An even camera, 31 values, 10 nm apart, before the parabola x^2 from -1 to 1: analytic means over the step around each value,
// at the ends held outside; chords are h^2 / 6 above it on the average; its slope at the ends is taken over 20 nm. The second
// channel was fitted, as much of it is negative.
TEST(GapNoise, SumsOverWavelengthEndWithHalfAStep)
{
  const msi::WavelengthGrid grid = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);
  const double N = 31.0;
  Eigen::MatrixXd responsivity = Eigen::MatrixXd::Constant(2, 31, 1.0 / N);
  responsivity(1, 15) = -0.06; // where the parabola is zero
  const msi::CameraModel camera(grid, responsivity, Eigen::VectorXd::Zero(2), { "even", "fitted" });
  msi::SceneSamples samples;
  samples.reflectance = Eigen::VectorXd::LinSpaced(31, -1.0, 1.0).cwiseAbs2().replicate(1, 2);
  const msi::GapCapture capture{ camera, grid, samples, responsivity * samples.reflectance,
    { 0, 1 }, msi::CameraNoise{ 0.001, 0.0 } };
  const double h = 1.0 / 15.0;
  const double around = h * h / 12.0;
  const double sum = (29.0 * around + (around - h / 2.0)) / N;
  const double curve = 30.0 * h * h / 6.0 / N;
  const double beyond = 2.0 * 0.25 * h / N * (2.0 - 2.0 * h);
  const double mean = 16.0 * 31.0 / 45.0 / N; // of j^2 / 225
  const double cut = 2.0 * 0.5 / N * (1.0 - mean);
  const double known = std::hypot(std::hypot(sum, curve, beyond), cut);
  const double fitted = std::hypot(curve - (0.06 + 1.0 / N) * h * h / 6.0, beyond);
  const Eigen::MatrixXd variance = msi::integrationVariance(msi::prepareGapData(capture, {}), grid);
  EXPECT_NEAR(std::sqrt(variance(0, 0)), known, 0.01 * known);
  EXPECT_NEAR(std::sqrt(variance(1, 0)), fitted, 0.05 * fitted);
}

// Passbands of one step before a reflectance that alternates between 1 and -1. Cubics through four points (Lagrange) make a piecewise
// polynomial of both: its integral is .6201 off the sum, and .0243 off that of straight lines between the reflectances. A camera that
// was fitted with the sum has no error of it, however much its responsivities alternate; and of the straight lines no more than the
// largest that they have, t^2 (1 - t) = 4 / 27 where the alternation begins.
TEST(GapNoise, WhatWasFittedWithTheSumHasNoErrorOfIt)
{
  const msi::WavelengthGrid grid = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);
  Eigen::MatrixXd responsivity = Eigen::MatrixXd::Zero(3, 31);
  responsivity(0, 10) = 1.0;
  responsivity.row(1)(Eigen::seqN(8, 7, 2)) << 2.0, -3.0, 4.0, -5.0, 4.0, -3.0, 2.0;
  responsivity.row(2).segment(15, 2) << 12.0, -11.0;
  const msi::CameraModel camera(
    grid, responsivity, Eigen::VectorXd::Zero(3), { "known", "fitted", "pseudoinverse" });
  msi::SceneSamples samples;
  samples.reflectance = Eigen::MatrixXd::Ones(31, 2);
  samples.reflectance(Eigen::seqN(5, 11, 2), Eigen::all).setConstant(-1.0);
  const msi::GapCapture capture{ camera, grid, samples, responsivity * samples.reflectance,
    { 0, 1 }, msi::CameraNoise{ 0.001, 0.0 } };
  const Eigen::MatrixXd variance = msi::integrationVariance(msi::prepareGapData(capture, {}), grid);
  EXPECT_TRUE((msi::fittedChannels(camera) == msi::ChannelMask{ { false, true, true } }).all());
  EXPECT_NEAR(std::sqrt(variance(0, 0)), std::hypot(0.6201, 0.0243), 0.02);
  EXPECT_NEAR(std::sqrt(variance(1, 0)), 0.0243, 0.005);
  EXPECT_NEAR(std::sqrt(variance(2, 0)), 4.0 / 27.0, 0.001);
}

// Counts of 8 bits divided by a white of 231, as text of four digits; their halves, as means of two exposures.
TEST(GapData, FindsTheStepToWhichReadingsAreRounded)
{
  std::mt19937 random(5);
  std::uniform_int_distribution<int> count(3, 228);
  std::vector<double> rounded, halves, even, few;
  for (int i = 0; i < 60; ++i)
  {
    rounded.push_back(std::round(count(random) / 231.0 * 1e4) * 1e-4);
    halves.push_back(0.5 * (count(random) + count(random)));
    even.push_back(0.02 * i + std::normal_distribution<double>(0.0, 0.001)(random));
    few.push_back(0.25 * (i % 7));
  }
  EXPECT_NEAR(msi::stepBetween(rounded), 1.0 / 231.0, 1e-6);
  EXPECT_EQ(msi::stepBetween(halves), 0.5);
  EXPECT_EQ(msi::stepBetween(even), 0.0);
  EXPECT_EQ(msi::stepBetween(few), 0.0);
  EXPECT_EQ(msi::stepBetween({}), 0.0);
}

// The mean of a rounded reading by numerical integration over the noise, its error over all places within a step.
TEST(GapNoise, WhatRepeatsOfRoundedReadingsShare)
{
  for (const double deviation : { 0.05, 0.1, 0.2, 0.4, 0.7 })
  {
    double variance = 0.0;
    for (int place = 0; place < 200; ++place)
    {
      const double x = (place + 0.5) / 200.0;
      double mean = 0.0;
      for (int whole = -8; whole <= 8; ++whole)
      {
        const auto below = [&](double edge)
        { return 0.5 * std::erfc((x - edge) / (deviation * std::sqrt(2.0))); };
        mean += whole * (below(whole + 0.5) - below(whole - 0.5));
      }
      variance += (mean - x) * (mean - x) / 200.0;
    }
    EXPECT_NEAR(msi::sharedRounding(9.0 * deviation * deviation, 3.0), 9.0 * variance, 2e-4);
  }
  EXPECT_EQ(msi::sharedRounding(0.01, 0.0), 0.0);
}

// A step of five times the noise: no excess noise; three repeats make the error only as much less as they differ. Seen over 672
// elements, whose squares' mean errs by 5 %; noise told from rounding by the repeats alone is a guess within a factor.
TEST(GapNoise, RoundingIsExpected)
{
  msi::GapCapture capture = captureOf(rasterSamples(96), {}, 3, 0.001);
  const double step = 0.0047;
  capture.readings = (capture.readings / step).array().round() * step;
  const msi::GapData data = msi::prepareGapData(capture, {});
  EXPECT_NEAR(data.step[0], step, 1e-12);
  const double seen = (data.observed - data.simulated).squaredNorm() / (96.0 * 7.0);
  const auto expected = [&](const std::optional<msi::CameraNoise>& model)
  {
    const msi::NoiseFinding found = msi::findNoise(data, model);
    EXPECT_EQ(found.excess, 1.0);
    return msi::readingVariance(data, found.reading).mean();
  };
  EXPECT_NEAR(expected(msi::CameraNoise{ 0.001, 0.0 }), seen, 0.15 * seen);
  EXPECT_NEAR(expected(std::nullopt), seen, 0.4 * seen);
}

// Of three readings, of which the capture keeps two; nothing where readings only jump by the step to which they are rounded, or
// where all exposures differ.
TEST(GapNoise, OnlyFewReadingsAreOdd)
{
  msi::GapCapture capture = captureOf(rasterSamples(96), {}, 3, 0.0002);
  msi::GapCapture rounded = capture;
  rounded.readings = (capture.readings / 0.0047).array().round() * 0.0047;
  EXPECT_TRUE(msi::leaveOutOddReadings(rounded, {}).empty());
  msi::GapCapture flickering = capture;
  const msi::CounterRandom random(9);
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    flickering.readings.col(j) *=
      1.0 + 0.03 * (random.uniform(static_cast<std::uint64_t>(j)) - 0.5);
  }
  EXPECT_TRUE(msi::leaveOutOddReadings(flickering, {}).empty());
  capture.readings(4, 3 * 20 + 1) = 1.0;
  capture.readings(2, 3 * 50 + 2) = 0.0;
  const std::vector<msi::OddReading> odd = msi::leaveOutOddReadings(capture, {});
  ASSERT_EQ(odd.size(), 2U);
  EXPECT_TRUE(std::isnan(capture.readings(4, 3 * 20 + 1)));
  EXPECT_TRUE(std::isnan(capture.readings(2, 3 * 50 + 2)));
  EXPECT_EQ(capture.readings.array().isNaN().count(), 2);
}

TEST(GapNoise, RepeatsGiveTheNoiseWhereNoModelIsGiven)
{
  msi::GapCapture capture = captureOf(rasterSamples(96), {}, 5, 0.002);
  capture.noise.reset();
  const msi::NoiseFinding found = msi::findNoise(msi::prepareGapData(capture, {}), capture.noise);
  EXPECT_TRUE(found.fromRepeats);
  EXPECT_FALSE(found.unknown);
  EXPECT_EQ(found.degrees, 96.0 * 7.0 * 4.0);
  // 2688 degrees of freedom: 1.4 % of the deviation; shot noise was not there.
  EXPECT_NEAR(std::hypot(found.reading.read, found.reading.shot * 0.3), 0.002, 0.0003);
}

TEST(GapNoise, RepeatsThatScatterMoreThanTheModelOverruleIt)
{
  msi::GapCapture capture = captureOf(rasterSamples(96), {}, 3, 0.002);
  capture.noise = msi::CameraNoise{ 0.001, 0.0 };
  const msi::NoiseFinding found = msi::findNoise(msi::prepareGapData(capture, {}), capture.noise);
  EXPECT_NEAR(found.excess, 2.0, 0.1);
  EXPECT_TRUE(found.fromRepeats);
  capture.noise = msi::CameraNoise{ 0.002, 0.0 };
  EXPECT_EQ(msi::findNoise(msi::prepareGapData(capture, {}), capture.noise).excess, 1.0);
}

TEST(GapNoise, OneReadingAndNoModelIsUnknown)
{
  msi::GapCapture capture = captureOf(rasterSamples(48), {}, 1);
  capture.noise.reset();
  EXPECT_TRUE(msi::findNoise(msi::prepareGapData(capture, {}), capture.noise).unknown);
}

// Independent errors of size s at every wavelength add up to s^2 sum of M^2.
TEST(GapNoise, ReflectanceErrorsGoThroughTheCamera)
{
  Eigen::MatrixXd responsivity(1, 3);
  responsivity << 0.5, 0.3, 0.2;
  const msi::CameraModel camera(
    msi::WavelengthGrid({ 400.0, 500.0, 600.0 }), responsivity, Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(msi::reflectanceErrorGain(camera)[0], 0.25 + 0.09 + 0.04, 1e-15);
}

constexpr double ModelNoise = 0.0005;

// One reading a sample with `noise`, its standard deviation given as ModelNoise.
msi::GapCapture understated(double noise, Eigen::Index samples = 96)
{
  msi::GapCapture capture = captureOf(rasterSamples(samples), {}, 1, noise);
  capture.noise = msi::CameraNoise{ ModelNoise, 0.0 };
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

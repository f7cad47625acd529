#include "Kernels/Camera/CameraNoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{

struct Moments
{
  double mean;
  double variance;
};

Moments momentsOf(const Eigen::MatrixXd& values)
{
  const double mean = values.mean();
  return { mean, (values.array() - mean).square().sum() / double(values.size() - 1) };
}

TEST(CameraNoise, TemporalNoiseHasTheContractedVariance)
{
  msi::CameraNoise noise;
  noise.read = 0.002;
  noise.shot = 0.01;
  const msi::NoiseGenerator add(noise, 5);
  constexpr Eigen::Index Count = 50000;
  for (const double level : { 0.0, 0.2, 0.9 })
  {
    Eigen::MatrixXd response = Eigen::MatrixXd::Constant(2, Count, level);
    add(response, 0);
    const Moments moments = momentsOf(response);
    const double variance = 0.002 * 0.002 + 0.01 * 0.01 * level;
    EXPECT_DOUBLE_EQ(msi::noiseVariance(noise, level), variance);
    const double draws = 2.0 * Count;
    EXPECT_NEAR(moments.mean, level, 5.0 * std::sqrt(variance / draws));
    EXPECT_NEAR(moments.variance, variance, 5.0 * variance * std::sqrt(2.0 / draws));
  }
}

TEST(CameraNoise, FixedPatternStaysFromExposureToExposure)
{
  msi::CameraNoise noise;
  noise.fixedPatternGain = 0.02;
  noise.fixedPatternOffset = 0.001;
  const msi::NoiseGenerator add(noise, 5);
  constexpr Eigen::Index Count = 40000;
  Eigen::MatrixXd first = Eigen::MatrixXd::Constant(1, Count, 0.5);
  Eigen::MatrixXd second = first;
  add(first, 0, 0);
  add(second, 0, 9);
  EXPECT_EQ(first, second);
  const double variance = 0.02 * 0.02 * 0.25 + 0.001 * 0.001;
  EXPECT_NEAR(momentsOf(first).variance, variance, 5.0 * variance * std::sqrt(2.0 / Count));
}

TEST(CameraNoise, ExposuresAreIndependent)
{
  msi::CameraNoise noise;
  noise.read = 0.01;
  const msi::NoiseGenerator add(noise, 5);
  constexpr Eigen::Index Count = 40000;
  Eigen::MatrixXd first = Eigen::MatrixXd::Zero(1, Count);
  Eigen::MatrixXd second = first;
  add(first, 0, 0);
  add(second, 0, 1);
  const double correlation = first.row(0).dot(second.row(0)) / (Count * 1e-4);
  EXPECT_NEAR(correlation, 0.0, 5.0 / std::sqrt(double(Count)));
}

// Between neighbouring channels, between neighbouring pixels of a row and of a column, and between fixed pattern and
// temporal noise.
TEST(CameraNoise, NeighboursAreNotCorrelated)
{
  constexpr Eigen::Index Channels = 7;
  constexpr Eigen::Index Width = 200;
  constexpr Eigen::Index Height = 150;
  msi::CameraNoise temporal;
  temporal.read = 1.0;
  msi::CameraNoise pattern;
  pattern.fixedPatternOffset = 1.0;
  Eigen::MatrixXf noise = Eigen::MatrixXf::Zero(Channels, Width * Height);
  Eigen::MatrixXf fixed = noise;
  msi::NoiseGenerator{ temporal, 5 }(noise, 0);
  msi::NoiseGenerator{ pattern, 5 }(fixed, 0);
  const auto correlation = [](const auto& a, const auto& b)
  {
    return a.template cast<double>().cwiseProduct(b.template cast<double>()).mean() *
      std::sqrt(double(a.size()));
  };
  const Eigen::Index pixels = Width * Height;
  EXPECT_LT(
    std::abs(correlation(noise.topRows(Channels - 1), noise.bottomRows(Channels - 1))), 5.0);
  EXPECT_LT(std::abs(correlation(noise.leftCols(pixels - 1), noise.rightCols(pixels - 1))), 5.0);
  EXPECT_LT(
    std::abs(correlation(noise.leftCols(pixels - Width), noise.rightCols(pixels - Width))), 5.0);
  EXPECT_LT(std::abs(correlation(noise, fixed)), 5.0);
}

// The vectorised path in single precision against the formula in double precision, with all terms at once.
TEST(CameraNoise, SinglePrecisionAgreesWithDouble)
{
  msi::CameraNoise noise;
  noise.read = 0.01;
  noise.shot = 0.02;
  noise.fixedPatternGain = 0.01;
  noise.fixedPatternOffset = 0.002;
  Eigen::ArrayXd factor = Eigen::ArrayXd::LinSpaced(5, 0.5, 2.0);
  const msi::NoiseGenerator add(noise, 9, factor);
  Eigen::MatrixXd exact = Eigen::MatrixXd::Random(5, 777);
  Eigen::MatrixXf single = exact.cast<float>();
  add(exact, 3, 1);
  add(single, 3, 1);
  EXPECT_LT((single.cast<double>() - exact).cwiseAbs().maxCoeff(), 2e-7);
}

TEST(CameraNoise, QuantisationRoundsToSteps)
{
  msi::CameraNoise noise;
  noise.quantisationStep = 0.25;
  Eigen::MatrixXd response(1, 3);
  response << 0.12, 0.13, 0.9;
  msi::NoiseGenerator{ noise, 1 }(response, 0);
  EXPECT_EQ(response, (Eigen::MatrixXd(1, 3) << 0.0, 0.25, 1.0).finished());
}

TEST(CameraNoise, AnySplitIntoBlocksGivesTheSameBytes)
{
  msi::CameraNoise noise;
  noise.read = 0.01;
  noise.shot = 0.02;
  noise.fixedPatternGain = 0.01;
  noise.quantisationStep = 1.0 / 4095.0;
  const msi::NoiseGenerator add(noise, 77);
  const Eigen::MatrixXf clean = Eigen::MatrixXf::Constant(3, 100, 0.4F);
  Eigen::MatrixXf whole = clean;
  add(whole, 1000, 2);
  Eigen::MatrixXf pieces = clean;
  for (const auto& [first, count] : { std::pair{ 41, 59 }, std::pair{ 0, 7 }, std::pair{ 7, 34 } })
  {
    add(pieces.middleCols(first, count), 1000U + static_cast<std::uint64_t>(first), 2);
  }
  EXPECT_EQ(whole, pieces);
}

TEST(CameraNoise, NoNoiseChangesNoBit)
{
  Eigen::MatrixXd response = Eigen::MatrixXd::Random(4, 50);
  const Eigen::MatrixXd before = response;
  msi::NoiseGenerator{ msi::CameraNoise{}, 3 }(response, 0);
  EXPECT_EQ(response, before);
}

TEST(CameraNoise, NaNStaysInItsOwnPixel)
{
  msi::CameraNoise noise;
  noise.read = 0.01;
  noise.shot = 0.01;
  const msi::NoiseGenerator add(noise, 3);
  Eigen::MatrixXd clean = Eigen::MatrixXd::Constant(1, 3, 0.5);
  Eigen::MatrixXd response = clean;
  response(0, 1) = std::numeric_limits<double>::quiet_NaN();
  add(clean, 0);
  add(response, 0);
  EXPECT_TRUE(std::isnan(response(0, 1)));
  EXPECT_EQ(response(0, 0), clean(0, 0));
  EXPECT_EQ(response(0, 2), clean(0, 2));
}

TEST(CameraNoise, RefusesNegativeNoiseAndNamesIt)
{
  msi::CameraNoise noise;
  noise.shot = -0.1;
  try
  {
    msi::NoiseGenerator add(noise, 1);
    FAIL() << "expected std::invalid_argument";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(), "the camera noise 'shot' is -0.1; expected zero or more");
  }
}

TEST(CameraNoise, IsFittedToTheVariancesAtSomeResponses)
{
  const Eigen::ArrayXd response = Eigen::ArrayXd::LinSpaced(9, 0.0, 0.8);
  const Eigen::ArrayXd weight = Eigen::ArrayXd::LinSpaced(9, 1.0, 5.0);
  const msi::CameraNoise both = msi::fittedNoise(response, 4e-6 + 1e-4 * response, weight);
  EXPECT_NEAR(both.read, 0.002, 1e-9);
  EXPECT_NEAR(both.shot, 0.01, 1e-9);
  // Variances that fall with the response: their mean.
  const Eigen::ArrayXd falling = 4e-6 - 1e-6 * response;
  const msi::CameraNoise read = msi::fittedNoise(response, falling, Eigen::ArrayXd::Ones(9));
  EXPECT_NEAR(read.read, std::sqrt(falling.mean()), 1e-12);
  EXPECT_EQ(read.shot, 0.0);
  // A line that would meet the axis below zero: one through the origin.
  const msi::CameraNoise shot =
    msi::fittedNoise(response, 1e-4 * response.square(), Eigen::ArrayXd::Ones(9));
  EXPECT_EQ(shot.read, 0.0);
  EXPECT_NEAR(shot.shot, 0.01 * std::sqrt(response.cube().sum() / response.square().sum()), 1e-12);
}

}

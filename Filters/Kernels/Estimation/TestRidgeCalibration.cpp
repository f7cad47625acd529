#include "Kernels/Estimation/RidgeCalibration.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace
{

msi::SampleSet randomSamples(
  Eigen::Index bands, Eigen::Index channels, Eigen::Index count, double noise, unsigned seed)
{
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto fill = [&](Eigen::Index rows, Eigen::Index cols)
  { return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }).eval(); };
  msi::SampleSet samples;
  samples.response = fill(channels, count);
  samples.reflectance = fill(bands, channels) * samples.response + noise * fill(bands, count);
  return samples;
}

TEST(RidgeCalibration, RecoversAnExactTransform)
{
  auto samples = randomSamples(5, 3, 20, 0.0, 1);
  samples.reflectance.array() += 0.25;
  const auto ridge = msi::fitRidge(samples);
  EXPECT_LT(
    (ridge.fit.transform(samples.response) - samples.reflectance).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LE(ridge.penalty, 1e-7);
}

// Leave-one-out by definition: fit without sample i at the same penalty and scaling, then predict it.
TEST(RidgeCalibration, ClosedFormLeaveOneOutIsLeavingOneOut)
{
  const auto samples = randomSamples(4, 3, 12, 0.5, 2);
  const auto ridge = msi::fitRidge(samples);
  const Eigen::Index count = samples.size();
  Eigen::VectorXd scale(3);
  for (Eigen::Index k = 0; k < 3; ++k)
  {
    const Eigen::ArrayXd row = samples.response.row(k);
    scale[k] = std::sqrt((row - row.mean()).square().mean());
  }
  double squared = 0.0;
  for (Eigen::Index out = 0; out < count; ++out)
  {
    // Normal equations with an unpenalized constant.
    Eigen::MatrixXd u(4, count - 1);
    Eigen::MatrixXd r(4, count - 1);
    for (Eigen::Index i = 0, next = 0; i < count; ++i)
    {
      if (i != out)
      {
        u.col(next) << samples.response.col(i).cwiseQuotient(scale), 1.0;
        r.col(next++) = samples.reflectance.col(i);
      }
    }
    Eigen::MatrixXd normal = u * u.transpose();
    normal.diagonal().head(3).array() += ridge.penalty * static_cast<double>(count);
    const Eigen::MatrixXd w = (normal.inverse() * u * r.transpose()).transpose();
    Eigen::VectorXd left(4);
    left << samples.response.col(out).cwiseQuotient(scale), 1.0;
    const Eigen::VectorXd expected = samples.reflectance.col(out) - w * left;
    EXPECT_LT((ridge.leftOut.col(out) - expected).norm(), 1e-9);
    squared += expected.squaredNorm();
  }
  EXPECT_NEAR(ridge.leaveOneOutRms, std::sqrt(squared / static_cast<double>(4 * count)), 1e-9);
  EXPECT_GT(ridge.penalty, 0.0);
  const Eigen::MatrixXd residual = samples.reflectance - ridge.fit.transform(samples.response);
  const Eigen::VectorXd part = (1.0 - ridge.leverage.array()).matrix();
  EXPECT_LT((ridge.leftOut * part.asDiagonal() - residual).norm(), 1e-9);
}

TEST(RidgeCalibration, GainOfAChannelDoesNotMatter)
{
  const auto samples = randomSamples(4, 3, 12, 0.5, 3);
  auto scaled = samples;
  scaled.response.row(1) *= 1e-3;
  const auto a = msi::fitRidge(samples);
  const auto b = msi::fitRidge(scaled);
  EXPECT_EQ(a.penalty, b.penalty);
  EXPECT_LT(
    (a.fit.transform(samples.response) - b.fit.transform(scaled.response)).cwiseAbs().maxCoeff(),
    1e-9);
}

TEST(RidgeCalibration, FewerSamplesThanChannelsAndADeadChannelAreSolved)
{
  auto samples = randomSamples(4, 8, 6, 0.1, 4);
  samples.response.row(2).setConstant(0.7);
  const auto ridge = msi::fitRidge(samples);
  EXPECT_TRUE(ridge.fit.transform.coefficients().allFinite());
  EXPECT_EQ(ridge.fit.transform.coefficients().col(2).norm(), 0.0);
  EXPECT_TRUE(std::isfinite(ridge.leaveOneOutRms));
}

TEST(RidgeCalibration, RefusesTwoSamples)
{
  try
  {
    msi::fitRidge(randomSamples(4, 3, 2, 0.0, 5));
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(),
      "there are 2 calibration samples; choosing the penalty by leaving one out needs at least 3");
  }
}

}

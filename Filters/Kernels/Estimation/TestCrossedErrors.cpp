#include "Kernels/Estimation/CrossedErrors.h"
#include "Kernels/Numerics/StudentQuantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace
{
// Errors with effects of the draw, of the sample and of both; a quarter of them is not held out.
Eigen::MatrixXd crossedErrors(std::mt19937_64& generator, Eigen::Index draws, Eigen::Index samples,
  double ofDraw, double ofSample, double ofBoth, const Eigen::MatrixXd& hidden)
{
  std::normal_distribution<double> normal;
  Eigen::VectorXd rows(draws);
  Eigen::RowVectorXd columns(samples);
  for (double& value : rows)
  {
    value = ofDraw * normal(generator);
  }
  for (double& value : columns)
  {
    value = ofSample * normal(generator);
  }
  Eigen::MatrixXd errors(draws, samples);
  for (Eigen::Index d = 0; d < draws; ++d)
  {
    for (Eigen::Index s = 0; s < samples; ++s)
    {
      errors(d, s) = hidden(d, s) < 0.25 ? std::numeric_limits<double>::quiet_NaN()
                                         : 1.0 + rows[d] + columns[s] + ofBoth * normal(generator);
    }
  }
  return errors;
}

Eigen::MatrixXd uniformNumbers(std::mt19937_64& generator, Eigen::Index rows, Eigen::Index columns)
{
  std::uniform_real_distribution<double> uniform;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}
}

// Published two-sided tables (NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2).
TEST(StudentQuantile, IsThatOfTheTables)
{
  EXPECT_NEAR(msi::studentQuantile(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(msi::studentQuantile(0.95, 2), 4.303, 5e-4);
  EXPECT_NEAR(msi::studentQuantile(0.95, 9), 2.262, 5e-4);
  EXPECT_NEAR(msi::studentQuantile(0.95, 30), 2.042, 5e-4);
  EXPECT_NEAR(msi::studentQuantile(0.90, 6), 1.943, 5e-4);
  EXPECT_NEAR(msi::studentQuantile(0.99, 4), 4.604, 5e-4);
  EXPECT_NEAR(msi::studentQuantile(0.95, 100000), 1.959963984540054, 5e-5);
}

TEST(CrossedErrors, IntervalsHoldTheTruth)
{
  struct Case
  {
    double ofDraw, ofSample, ofBoth;
  };
  for (const Case& effects :
    { Case{ 0.05, 0.05, 0.05 }, Case{ 0.1, 0.0, 0.1 }, Case{ 0.0, 0.1, 0.1 } })
  {
    std::mt19937_64 generator(3);
    constexpr int Trials = 1500;
    int ofMean = 0;
    int ofRatio = 0;
    for (int trial = 0; trial < Trials; ++trial)
    {
      const Eigen::MatrixXd hidden = uniformNumbers(generator, 8, 40);
      const auto draw = [&](double level)
      {
        return Eigen::MatrixXd(level *
          crossedErrors(
            generator, 8, 40, effects.ofDraw, effects.ofSample, effects.ofBoth, hidden));
      };
      const Eigen::MatrixXd first = draw(2.0);
      const Eigen::MatrixXd second = draw(5.0);
      const msi::ErrorInterval mean = msi::meanError(first);
      const msi::PairedErrors pair = msi::compareErrors(first, second);
      ofMean += mean.low <= 2.0 && 2.0 <= mean.high ? 1 : 0;
      ofRatio += pair.ratio.low <= 0.4 && 0.4 <= pair.ratio.high ? 1 : 0;
    }
    // Three standard errors of a share of .95 are .017; few clusters make intervals a little wide.
    EXPECT_GT(ofMean, 0.93 * Trials);
    EXPECT_GT(ofRatio, 0.93 * Trials);
    EXPECT_LT(ofMean, 0.995 * Trials);
    EXPECT_LT(ofRatio, 0.995 * Trials);
  }
}

TEST(CrossedErrors, PairsTakeOutWhatBothShare)
{
  std::mt19937_64 generator(5);
  const Eigen::MatrixXd hidden = uniformNumbers(generator, 6, 30);
  const Eigen::MatrixXd shared = crossedErrors(generator, 6, 30, 0.1, 0.1, 0.02, hidden);
  const msi::PairedErrors pair = msi::compareErrors(0.9 * shared, shared);
  EXPECT_NEAR(pair.ratio.value, 0.9, 1e-12);
  EXPECT_NEAR(pair.ratio.high, 0.9, 1e-9); // the same errors up to scale: nothing is uncertain
  EXPECT_EQ(pair.wins, 1.0);
  EXPECT_EQ(pair.sign(), -1);
  EXPECT_EQ(msi::compareErrors(shared, 0.9 * shared).sign(), 1);
  EXPECT_EQ(msi::compareErrors(shared, shared).wins, 0.5);
  EXPECT_EQ(msi::compareErrors(shared, shared).sign(), 0);
}

TEST(CrossedErrors, OneDrawHasNoInterval)
{
  const Eigen::MatrixXd one = Eigen::RowVector3d(1.0, 2.0, 3.0);
  EXPECT_DOUBLE_EQ(msi::meanError(one).value, 2.0);
  EXPECT_TRUE(std::isnan(msi::meanError(one).low));
  EXPECT_EQ(msi::compareErrors(one, 2.0 * one).sign(), 0);
  EXPECT_THROW(msi::compareErrors(one, Eigen::MatrixXd::Ones(2, 3)), std::invalid_argument);
}

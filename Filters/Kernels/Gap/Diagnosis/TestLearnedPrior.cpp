#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/FoundCauses.h"
#include "Kernels/Gap/Diagnosis/LinearFit.h"
#include "Kernels/Gap/ReportParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{

// Minus the logarithm of a Cauchy density is that at 0 plus ln(1 + (x / scale)^2).
TEST(LearnedPrior, ACommonNumberIsCauchyByItsTypicalSize)
{
  const msi::LearnedPrior prior({ { 0, false, false, 0.3, 0.1 } });
  ASSERT_EQ(prior.distribution.blocks().size(), 1U);
  EXPECT_NEAR(prior.distribution.blocks().front().variance, 0.01, 1e-15);
  EXPECT_NEAR(prior.surprise, std::log(10.0), 1e-12);
  EXPECT_NEAR(prior.distribution.gain(Eigen::MatrixXd::Constant(1, 1, 500.0).sparseView()),
    0.5 * std::log(6.0), 1e-12);
  // A mean of their own have numbers of channels only.
  EXPECT_NEAR(msi::LearnedPrior({ { 0, false, true, 0.3, 0.1 } }).surprise, std::log(10.0), 1e-12);
}

// Numbers +-d scatter by d: each is one deviation from its mean, whatever d is.
TEST(LearnedPrior, NumbersOfChannelsLearnTheirScatter)
{
  for (const double size : { 0.01, 0.5 })
  {
    const msi::LearnedPrior prior({ { 0, true, false, size, 1.0 }, { 0, true, false, -size, 1.0 },
      { 1, false, false, 0.0, 3.0 } });
    const std::vector<msi::PriorBlock>& blocks = prior.distribution.blocks();
    ASSERT_EQ(blocks.size(), 2U);
    EXPECT_EQ(blocks[0].size, 2);
    EXPECT_NEAR(blocks[0].variance, size * size, 1e-9);
    EXPECT_EQ(blocks[0].ofMean, 0.0);
    EXPECT_DOUBLE_EQ(blocks[1].variance, 9.0);
    EXPECT_NEAR(prior.surprise, 1.0, 1e-6);
  }
}

// Expectation and maximization: what is not known of the numbers adds to their variance.
TEST(LearnedPrior, UncertainNumbersMayScatterMore)
{
  const msi::LearnedPrior prior(
    { { 0, true, false, 0.3, 1.0, 0.07 }, { 0, true, false, -0.3, 1.0, 0.07 } });
  EXPECT_NEAR(prior.distribution.blocks().front().variance, 0.09 + 0.07, 1e-9);
}

// What is common to all channels is a number of its own where the effect has a form with one: 1 of typical size, +-.1 about it.
TEST(LearnedPrior, ACommonPartIsNoScatter)
{
  const msi::LearnedPrior prior({ { 0, true, true, 1.1, 1.0 }, { 0, true, true, 0.9, 1.0 } });
  EXPECT_NEAR(prior.distribution.blocks().front().ofMean, 1.0, 1e-12);
  EXPECT_NEAR(prior.distribution.blocks().front().variance, 0.01, 1e-6);
  EXPECT_NEAR(prior.surprise, 1.0 + std::log(2.0), 1e-6);
}

// Six equal numbers follow a cubic; a lens whose image is as large in every channel has no other effect behind it.
TEST(LearnedPrior, NumbersThatAPatternTellsMayFollowACurve)
{
  msi::FreeNumber number{ 0, true, false, 0.3, 1.0 };
  EXPECT_LT(msi::LearnedPrior(std::vector<msi::FreeNumber>(6, number)).chanceOfCurve, 1e-6);
  number.mayFollowCurve = true;
  EXPECT_EQ(msi::LearnedPrior(std::vector<msi::FreeNumber>(6, number)).chanceOfCurve, 1.0);
}

TEST(LearnedPrior, ANumberNearNeutralIsNormal)
{
  msi::FreeNumber number{ 0, false, false, 0.3, 0.1 };
  number.normal = true;
  EXPECT_NEAR(msi::LearnedPrior({ number }).surprise, 4.5, 1e-12);
}

// Three numbers that do the same: data tell 1/2 ln(1 + 3 x information x 100), and of each at least what is not known of the others.
TEST(BlockPrior, NumbersThatDoTheSameAreFittedHoweverMuchDataTell)
{
  const msi::BlockPrior prior({ { 3, 100.0 } });
  for (const double information : { 1e-3, 1e6, 1e18, 5e284 })
  {
    const msi::SparseMatrix normal = Eigen::MatrixXd::Constant(3, 3, information).sparseView();
    const double told = 0.5 * std::log1p(3.0 * information * 100.0);
    EXPECT_GT(prior.gain(normal), told - 1e-6);
    EXPECT_TRUE(std::isfinite(prior.gain(normal)));
    const Eigen::VectorXd variance = msi::diagonalOfInverse(prior.after(normal));
    EXPECT_GT(variance.minCoeff(), 0.0);
    EXPECT_LT(variance.maxCoeff(), 100.0);
    if (information < 1e7)
    {
      EXPECT_NEAR(prior.gain(normal), told, 1e-3);
      EXPECT_NEAR(variance.mean(), 100.0 - 1e4 * information / (1.0 + 300.0 * information), 0.1);
    }
  }
}

TEST(FitPrior, IsWideUntilNumbersOfChannelsAreKnown)
{
  const double wide = msi::wideVariance(0.5);
  const auto variances = [](double deviation)
  {
    const msi::BlockPrior prior = msi::fitPrior({ { 0, true, false, deviation, 0.5 },
      { 0, true, false, -deviation, 0.5 }, { 1, false, false, 0.2, 0.5 } });
    return Eigen::Vector2d(prior.blocks()[0].variance, prior.blocks()[1].variance);
  };
  EXPECT_EQ(variances(0.0), Eigen::Vector2d(wide, wide));
  EXPECT_NEAR(variances(0.2)[0], 0.04, 1e-6);
  EXPECT_EQ(variances(0.2)[1], wide);
}

TEST(LearnedPrior, NothingFreeIsNothingKnown)
{
  const msi::LearnedPrior prior({});
  EXPECT_EQ(prior.distribution.gain(msi::SparseMatrix()), 0.0);
  EXPECT_EQ(prior.surprise, 0.0);
}

TEST(UnknownProbability, GrowsWithWhatIsLeft)
{
  // Never less likely than an effect of the library is before the data speak.
  const double before = std::exp(-msi::Decision::EffectImprobability);
  EXPECT_NEAR(msi::unknownProbability(1.0), before / (1.0 + before), 1e-12);
  EXPECT_LT(msi::unknownProbability(0.9), 0.25);
  EXPECT_NEAR(msi::unknownProbability(1.0 - msi::Decision::UnknownRest), 0.5, before);
  EXPECT_GT(msi::unknownProbability(0.0), 0.7);
  // 1 / (-e p ln p) times that of an effect: the largest odds that the chance p can give.
  const double chance = 1e-4;
  const double odds =
    std::exp(-msi::Decision::EffectImprobability - 1.0) / (-chance * std::log(chance));
  EXPECT_NEAR(msi::unknownProbability(1.0, chance), odds / (1.0 + odds), 1e-12);
  EXPECT_EQ(msi::unknownProbability(1.0, 0.5), msi::unknownProbability(1.0));
  // Odds of e^-1 for each sign that effects stand for another.
  EXPECT_NEAR(msi::unknownProbability(1.0, 1.0, 2), 2.0 / (2.0 + std::exp(1.0)), before);
  EXPECT_EQ(msi::unknownProbability(-0.5), msi::unknownProbability(0.0));
}

TEST(Verdict, FollowsTheShrink)
{
  EXPECT_EQ(msi::verdictOf(0.9), msi::GapVerdict::Explained);
  EXPECT_EQ(msi::verdictOf(0.5), msi::GapVerdict::PartlyExplained);
  EXPECT_EQ(msi::verdictOf(0.1), msi::GapVerdict::Unexplained);
}

// Of so many channels: this part of the energy in one number for all, the rest in a difference that no curve has.
Eigen::VectorXd partlyAlike(double part, Eigen::Index channels, const Eigen::VectorXd& difference)
{
  Eigen::VectorXd deviations =
    Eigen::VectorXd::Constant(channels, std::sqrt(part / static_cast<double>(channels)));
  deviations.head(difference.size()) += std::sqrt(1.0 - part) * difference.normalized();
  return deviations;
}

// Densities: of Beta(2, 2) 6 x (1 - x), of Beta(2, 6) 42 x (1 - x)^5, of Beta(1, 1) 1, of Beta(1/2, 1) 1 / (2 sqrt(x)).
TEST(ChannelStructure, ChanceIsTheTailOfItsDensity)
{
  Eigen::VectorXd fourth(5);
  fourth << 1, -4, 6, -4, 1;
  const Eigen::Vector3d second(1, -2, 1);
  const Eigen::Vector2d first(1, -1);
  EXPECT_NEAR(
    msi::chanceOfCurve(partlyAlike(0.7, 8, fourth)), 1.0 - 3.0 * 0.49 + 2.0 * 0.343, 1e-12);
  EXPECT_NEAR(msi::chanceOfCurve(partlyAlike(0.9, 16, fourth)), 7.0 * 1e-6 - 6.0 * 1e-7, 1e-15);
  EXPECT_NEAR(msi::chanceOfCurve(partlyAlike(0.9, 4, second)), 0.1, 1e-12);
  EXPECT_NEAR(msi::chanceOfCurve(partlyAlike(0.81, 3, first)), 1.0 - 0.9, 1e-12);
  EXPECT_NEAR(msi::chanceOfCurve(partlyAlike(0.0, 8, fourth)), 1.0, 1e-12);
  EXPECT_EQ(msi::chanceOfCurve(Eigen::VectorXd::Ones(1)), 1.0);
  EXPECT_EQ(msi::chanceOfCurve(Eigen::VectorXd::Zero(12)), 1.0);
}

// Three and four independent gains are hardly ever the same, or on a line.
TEST(ChannelStructure, FewChannelsMayHaveOneNumberOrALine)
{
  EXPECT_NEAR(msi::chanceOfCurve(Eigen::Vector3d(0.05, 0.05, 0.05)), 0.0, 1e-12);
  EXPECT_NEAR(
    msi::chanceOfCurve(Eigen::Vector3d(1.0, 0.0, 0.0)), 1.0 - std::sqrt(1.0 / 3.0), 1e-12);
  EXPECT_NEAR(msi::chanceOfCurve(Eigen::Vector4d(0.01, 0.03, 0.05, 0.07)), 0.0, 1e-12);
}

TEST(ChannelStructure, CurvesOverTheChannelsAreCommonAlternationIsNot)
{
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(12, 0.0, 1.0);
  EXPECT_NEAR(
    msi::chanceOfCurve((0.02 + 0.1 * x - 0.3 * x.square() + x.cube()).matrix()), 0.0, 1e-12);
  Eigen::VectorXd alternating(12);
  alternating << 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1;
  EXPECT_GT(msi::chanceOfCurve(alternating), 0.9);
}

} // namespace

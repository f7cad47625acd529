#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/MetamerismCorrection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace
{

using msi::BandStructure;
using msi::test::ExpectedEstimation;
using msi::test::largestDifference;
using msi::test::messageOf;
using msi::test::randomMatrix;

msi::MetamerismOptions withStructure(BandStructure structure)
{
  msi::MetamerismOptions options;
  options.structure = structure;
  return options;
}

// Three-dimensional reflectances seen by three channels: exactly invertible.
struct ExactCase
{
  Eigen::MatrixXd basis = randomMatrix(8, 3, 1);
  msi::AffineTransform camera{ randomMatrix(3, 4, 2) };
  msi::SampleSet samples(Eigen::Index count, unsigned seed) const
  {
    const Eigen::MatrixXd weights = randomMatrix(3, count, seed);
    return { basis * weights, camera(weights) };
  }
};

TEST(MetamerismCorrection, AgreesWithNumPy)
{
  for (const int problem : { 0, 1 })
  {
    const ExpectedEstimation expected(problem);
    const auto structure =
      expected["neighbours"](0, 0) > 0.5 ? BandStructure::Tridiagonal : BandStructure::Diagonal;
    const auto fit = msi::fitMetamerismCorrection(
      expected.calibration(), expected.tuning(), withStructure(structure));
    EXPECT_LT(largestDifference(fit.reflectance.coefficients(), expected["banded_w"]), 1e-9);
    EXPECT_LT(largestDifference(fit.metamerism.coefficients(), expected["banded_d"]), 1e-9);
    EXPECT_LT(largestDifference(fit.composite.coefficients(), expected["banded"]), 1e-9);
    EXPECT_EQ(fit.structure, structure);
    EXPECT_EQ(fit.history.size(), 2U);
    EXPECT_EQ(fit.summary.iterations, 2);
    EXPECT_TRUE(fit.summary.complete) << fit.summary.status;
  }
}

TEST(MetamerismCorrection, UndoesAChannelwiseChangeOfResponseExactly)
{
  const ExactCase exact;
  const auto calibration = exact.samples(20, 3);
  auto target = exact.samples(15, 4);
  const Eigen::Vector3d gain(1.2, 0.8, 0.9);
  const Eigen::Vector3d stray(0.05, -0.02, 0.01);
  target.response = (gain.asDiagonal() * target.response).colwise() + stray;
  const auto fit = msi::fitMetamerismCorrection(
    calibration, target.subset({ 0, 1, 2, 3 }), withStructure(BandStructure::Diagonal));
  EXPECT_LT(largestDifference(fit.composite(target.response), target.reflectance), 1e-11);
  const Eigen::Vector3d found = fit.metamerism.linear().diagonal();
  EXPECT_LT(largestDifference(found, gain.cwiseInverse()), 1e-11);
  EXPECT_LT(fit.summary.residualRms, 1e-12);
}

TEST(MetamerismCorrection, DoesNotDependOnTheUnitOfTheResponse)
{
  const ExpectedEstimation expected(1);
  auto calibration = expected.calibration();
  auto tuning = expected.tuning();
  const auto options = withStructure(BandStructure::Diagonal);
  const auto before =
    msi::fitMetamerismCorrection(calibration, tuning, options).composite(tuning.response);
  calibration.response *= 255.0;
  tuning.response *= 255.0;
  const auto after =
    msi::fitMetamerismCorrection(calibration, tuning, options).composite(tuning.response);
  EXPECT_LT(largestDifference(before, after), 1e-9);
}

TEST(MetamerismCorrection, ChoosesTheStructureFromTheSpacingOfTheChannels)
{
  using msi::WavelengthGrid;
  EXPECT_EQ(msi::bandStructureFor(9), BandStructure::Diagonal);
  EXPECT_EQ(msi::bandStructureFor(16), BandStructure::Tridiagonal);
  EXPECT_EQ(
    msi::bandStructureFor(9, WavelengthGrid({ 400, 440, 480, 520, 560, 600, 640, 680, 700 })),
    BandStructure::Diagonal);
  EXPECT_EQ(
    msi::bandStructureFor(16, WavelengthGrid::uniform(400, 700, 20)), BandStructure::Tridiagonal);
  EXPECT_EQ(
    msi::bandStructureFor(9, WavelengthGrid::uniform(400, 560, 20)), BandStructure::Tridiagonal);
  EXPECT_EQ(msi::bandStructureFor(1), BandStructure::Diagonal);
}

TEST(MetamerismCorrection, StopsOnTheChangeOfTheMeanColorDifference)
{
  const ExpectedEstimation expected(0);
  const auto calibration = expected.calibration();
  const auto tuning = expected.tuning();
  msi::ColorStopRule rule;
  rule.tristimulusWeights = 100.0 / 8.0 * (randomMatrix(3, 8, 5).array() * 0.5 + 1.0).matrix();
  rule.white = rule.tristimulusWeights.rowwise().sum();
  rule.threshold = 0.0;
  auto options = withStructure(BandStructure::Tridiagonal);
  options.colorStop = rule;
  options.maximumRounds = 12;
  const auto all = msi::fitMetamerismCorrection(calibration, tuning, options);
  ASSERT_GT(all.history.size(), 3U);

  // Each round's value is that of a fit that ends there.
  const msi::CIELAB space(rule.white);
  for (int rounds = 1; rounds <= 3; ++rounds)
  {
    options.maximumRounds = rounds;
    const auto fit = msi::fitMetamerismCorrection(calibration, tuning, options);
    const Eigen::MatrixXd estimate = fit.composite(tuning.response);
    double mean = 0.0;
    for (Eigen::Index i = 0; i < tuning.size(); ++i)
    {
      const Eigen::Vector3d measured = rule.tristimulusWeights * tuning.reflectance.col(i);
      const Eigen::Vector3d estimated = rule.tristimulusWeights * estimate.col(i);
      mean += msi::CIEDE2000()(space.fromXYZ(measured), space.fromXYZ(estimated)) /
        static_cast<double>(tuning.size());
    }
    EXPECT_NEAR(*all.history[static_cast<std::size_t>(rounds - 1)].meanColorDifference, mean, 1e-9);
  }

  // A threshold between two changes stops at the first round whose change is below it.
  const auto change = [&](std::size_t round)
  {
    return std::abs(
      *all.history[round].meanColorDifference - *all.history[round - 1].meanColorDifference);
  };
  options.colorStop->threshold = 1.01 * change(2);
  options.maximumRounds = 12;
  const auto stopped = msi::fitMetamerismCorrection(calibration, tuning, options);
  const std::size_t expectedRounds = change(1) < options.colorStop->threshold ? 2 : 3;
  EXPECT_EQ(stopped.history.size(), expectedRounds);
  EXPECT_NE(stopped.summary.status.find("stopped by the change of the mean color difference"),
    std::string::npos);
}

TEST(MetamerismCorrection, ReducesTheStructureForFewSamplesAndSaysSo)
{
  const ExactCase exact;
  const auto calibration = exact.samples(20, 6);
  const auto tuning = exact.samples(3, 7);
  msi::MetamerismOptions options;
  options.channelWavelengths = msi::WavelengthGrid({ 500, 510, 520 });
  const auto fit = msi::fitMetamerismCorrection(calibration, tuning, options);
  EXPECT_EQ(fit.structure, BandStructure::Diagonal);
  EXPECT_FALSE(fit.summary.complete);
  EXPECT_EQ(fit.summary.status,
    "diagonal transform after 2 rounds; diagonal because a tridiagonal "
    "one needs 4 tuning samples and there are 3");
}

TEST(MetamerismCorrection, LeavesAChannelThatTheSamplesCannotTellAndSaysSo)
{
  const ExactCase exact;
  const auto calibration = exact.samples(20, 8);
  const auto one = exact.samples(1, 9);
  const auto same = one.subset({ 0, 0, 0 });
  const auto fit =
    msi::fitMetamerismCorrection(calibration, same, withStructure(BandStructure::Diagonal));
  EXPECT_LT(
    largestDifference(fit.metamerism.coefficients(), Eigen::MatrixXd::Identity(3, 4)), 1e-10);
  EXPECT_FALSE(fit.summary.complete);
  EXPECT_EQ(fit.summary.status,
    "diagonal transform after 2 rounds; undetermined and kept nearest to "
    "no change in channel 1, 2 and 3");
}

TEST(MetamerismCorrection, RefusesBadInputAndSaysWhy)
{
  const ExpectedEstimation expected(0);
  const auto calibration = expected.calibration();
  const auto tuning = expected.tuning();
  const auto fit = [&](const msi::SampleSet& used, const msi::MetamerismOptions& options = {})
  { return messageOf([&] { msi::fitMetamerismCorrection(calibration, used, options); }); };

  EXPECT_EQ(fit(tuning.subset({ 0, 1, 2 }), withStructure(BandStructure::Tridiagonal)),
    "there are 3 tuning samples for 4 unknowns a channel of the tridiagonal metamerism transform; "
    "expected at least 4 samples");
  EXPECT_EQ(fit(tuning.subset({ 0 })),
    "there is 1 tuning sample for 2 unknowns a channel of the diagonal metamerism transform; "
    "expected at least 2 samples");
  auto bad = tuning;
  bad.reflectance(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fit(bad), "tuning sample 3, reflectance band 2 is nan; expected a finite number");
  bad = tuning;
  bad.response.conservativeResize(4, Eigen::NoChange);
  EXPECT_EQ(fit(bad),
    "calibration has 5 response channels but tuning has 4; expected the same response channels in "
    "both");

  msi::MetamerismOptions options;
  options.maximumRounds = 0;
  EXPECT_EQ(fit(tuning, options), "the number of rounds is 0; expected at least 1");
  options = {};
  options.tuningWeight = -1.0;
  EXPECT_EQ(fit(tuning, options),
    "the tuning weight is -1; expected a positive finite number, or 0 for sqrt(L_A / L_T)");
  options = {};
  options.channelWavelengths = msi::WavelengthGrid({ 400, 500 });
  EXPECT_EQ(fit(tuning, options),
    "2 channel wavelengths are given for 5 response channels; expected one a channel");
  options = {};
  options.colorStop = msi::ColorStopRule{ Eigen::MatrixXd::Ones(3, 4) };
  EXPECT_EQ(fit(tuning, options),
    "the tristimulus weights of the color stop rule are 3 x 4; "
    "expected 3 x 8, a column per reflectance band");

  const msi::SampleSet wide{ randomMatrix(2, 20, 1), randomMatrix(3, 20, 2) };
  EXPECT_EQ(messageOf([&] { msi::fitMetamerismCorrection(wide, wide); }),
    "there are 3 response channels but only 2 reflectance bands; the metamerism correction expects "
    "at least as many bands");
}

}

#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Estimation/RModelCorrection.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

using msi::test::ExpectedEstimation;
using msi::test::largestDifference;
using msi::test::messageOf;
using msi::test::randomMatrix;

constexpr double Tolerance = 1e-9;
using msi::test::NaN;

TEST(PseudoinverseCalibration, AgreesWithNumPy)
{
  for (const int problem : { 0, 1 })
  {
    const ExpectedEstimation expected(problem);
    const auto calibration = expected.calibration();
    const auto tuning = expected.tuning();
    const auto direct = msi::fitPseudoinverse(calibration);
    EXPECT_LT(largestDifference(direct.transform.coefficients(), expected["direct"]), Tolerance);
    EXPECT_LT(
      largestDifference(msi::fitPseudoinverse(tuning).transform.coefficients(), expected["pinv"]),
      Tolerance);
    EXPECT_LT(largestDifference(
                msi::fitPooled(calibration, tuning).transform.coefficients(), expected["pooled"]),
      Tolerance);
    EXPECT_TRUE(direct.summary.complete);
    EXPECT_EQ(direct.summary.rank, calibration.channels() + 1);
    EXPECT_EQ(direct.summary.unknowns, calibration.bands() * (calibration.channels() + 1));
    EXPECT_EQ(direct.summary.samples, calibration.size());
  }
}

TEST(PseudoinverseCalibration, RecoversAnAffineMapAndItsSummary)
{
  const msi::AffineTransform truth(randomMatrix(6, 4, 1));
  const Eigen::MatrixXd responses = randomMatrix(3, 20, 2);
  const auto fit = msi::fitPseudoinverse({ truth(responses), responses });
  EXPECT_LT(largestDifference(fit.transform.coefficients(), truth.coefficients()), 1e-13);
  EXPECT_LT(fit.summary.residualRms, 1e-14);

  // Singular values of (U; 1) for U = (1, -1): both sqrt(2).
  const auto two =
    msi::fitPseudoinverse({ Eigen::RowVector2d(0.3, 0.1), Eigen::RowVector2d(1.0, -1.0) });
  EXPECT_NEAR(two.summary.condition, 1.0, 1e-14);
  EXPECT_TRUE(two.transform.coefficients().isApprox(Eigen::RowVector2d(0.1, 0.2), 1e-14));
}

TEST(PseudoinverseCalibration, TakesTheLeastNormWhereUndeterminedAndSaysSo)
{
  // One sample u = 3, r = 5: of all (a, b) with 3 a + b = 5 the shortest is 5 (3, 1) / 10.
  const auto fit = msi::fitPseudoinverse(
    { Eigen::MatrixXd::Constant(1, 1, 5), Eigen::MatrixXd::Constant(1, 1, 3) });
  EXPECT_TRUE(fit.transform.coefficients().isApprox(Eigen::RowVector2d(1.5, 0.5), 1e-14));
  EXPECT_FALSE(fit.summary.complete);
  EXPECT_EQ(fit.summary.rank, 1);
  EXPECT_EQ(fit.summary.status,
    "undetermined: the 1 sample has rank 1 but a band has 2 unknowns; the transform of least "
    "norm "
    "was taken, use more or more varied samples");

  // A doubled channel shares its weight equally.
  Eigen::MatrixXd responses = randomMatrix(3, 12, 3);
  responses.row(2) = responses.row(0);
  const auto doubled = msi::fitPseudoinverse({ randomMatrix(5, 12, 4), responses });
  EXPECT_EQ(doubled.summary.rank, 3);
  EXPECT_LT(largestDifference(
              doubled.transform.coefficients().col(0), doubled.transform.coefficients().col(2)),
    1e-12);
}

TEST(PseudoinverseCalibration, RankToleranceDropsWeakDirections)
{
  Eigen::MatrixXd responses = randomMatrix(2, 12, 5);
  responses.row(1) = responses.row(0) + 1e-6 * responses.row(1);
  const msi::SampleSet samples{ randomMatrix(4, 12, 6), responses };
  EXPECT_EQ(msi::fitPseudoinverse(samples).summary.rank, 3);
  EXPECT_EQ(msi::fitPseudoinverse(samples, { 1e-4 }).summary.rank, 2);
}

TEST(PseudoinverseCalibration, DoesNotDependOnTheOrderOfSamples)
{
  const ExpectedEstimation expected(0);
  const auto samples = expected.calibration();
  const auto shuffled = samples.subset({ 5, 0, 13, 2, 7, 1, 9, 3, 12, 4, 11, 6, 10, 8 });
  EXPECT_LT(largestDifference(msi::fitPseudoinverse(samples).transform.coefficients(),
              msi::fitPseudoinverse(shuffled).transform.coefficients()),
    1e-12);
}

TEST(PseudoinverseCalibration, PooledWeightCountsASampleSquaredTimes)
{
  const ExpectedEstimation expected(1);
  const auto calibration = expected.calibration();
  const auto tuning = expected.tuning();
  auto fourTimes = msi::joined(tuning, tuning);
  fourTimes = msi::joined(fourTimes, fourTimes);
  EXPECT_LT(largestDifference(msi::fitPooled(calibration, tuning, 2.0).transform.coefficients(),
              msi::fitPooled(calibration, fourTimes).transform.coefficients()),
    1e-11);
}

TEST(PseudoinverseCalibration, RefusesBadInputAndSaysWhy)
{
  const ExpectedEstimation expected(0);
  auto calibration = expected.calibration();
  const auto tuning = expected.tuning();
  EXPECT_EQ(messageOf([&] { msi::fitPooled(calibration, ExpectedEstimation(1).tuning()); }),
    "calibration has 8 reflectance bands but tuning has 7; expected the same reflectance bands in "
    "both");
  EXPECT_EQ(messageOf([&] { msi::fitPooled(calibration, tuning, 0.0); }),
    "the tuning weight is 0; expected a positive finite number");
  EXPECT_EQ(messageOf(
              [&] {
                msi::fitPseudoinverse({ calibration.reflectance, tuning.response });
              }),
    "calibration has 14 reflectances but 9 responses; expected one of each per sample");
  EXPECT_EQ(messageOf([&] { msi::fitPseudoinverse({}); }),
    "calibration has 0 samples, 0 reflectance bands and 0 response channels; expected at least one "
    "of each");
  calibration.response(2, 4) = NaN;
  EXPECT_EQ(messageOf([&] { msi::fitPseudoinverse(calibration); }),
    "calibration sample 5, response channel 3 is nan; expected a finite number");
}

TEST(RModelCorrection, AgreesWithNumPy)
{
  for (const int problem : { 0, 1 })
  {
    const ExpectedEstimation expected(problem);
    const auto direct = msi::fitPseudoinverse(expected.calibration());
    const auto fit = msi::fitRModel(direct.transform(expected["V"]), expected["S"]);
    const auto whole = msi::AffineTransform::compose(fit.correction, direct.transform);
    EXPECT_LT(largestDifference(whole.coefficients(), expected["r_model"]), Tolerance);
    EXPECT_TRUE(fit.summary.complete);
  }
}

TEST(RModelCorrection, RecoversATridiagonalMap)
{
  Eigen::MatrixXd truth = randomMatrix(6, 7, 7);
  for (Eigen::Index i = 0; i < 6; ++i)
  {
    for (Eigen::Index j = 0; j < 6; ++j)
    {
      truth(i, j) = std::abs(i - j) <= 1 ? truth(i, j) : 0.0;
    }
  }
  const Eigen::MatrixXd estimated = randomMatrix(6, 9, 8);
  const auto fit = msi::fitRModel(estimated, msi::AffineTransform(truth)(estimated));
  EXPECT_LT(largestDifference(fit.correction.coefficients(), truth), 1e-12);
  EXPECT_EQ(fit.summary.unknowns, 2 * 3 + 4 * 4);
  EXPECT_EQ(fit.summary.status, "fitted to 9 tuning samples");
}

TEST(RModelCorrection, KeepsWhatTheSamplesCannotTell)
{
  // Every band of every sample is the same: the change along (1, 1, 1, 1) is known, the rest is not.
  const Eigen::MatrixXd estimated = Eigen::MatrixXd::Constant(5, 6, 1.0);
  const auto fit = msi::fitRModel(estimated, estimated);
  EXPECT_LT(
    largestDifference(fit.correction.coefficients(), Eigen::MatrixXd::Identity(5, 6)), 1e-13);
  EXPECT_FALSE(fit.summary.complete);
  EXPECT_EQ(fit.summary.status,
    "fitted to 6 tuning samples; undetermined and kept nearest to no "
    "change in 5 of 5 bands");
}

TEST(RModelCorrection, RefusesBadInputAndSaysWhy)
{
  const Eigen::MatrixXd estimated = randomMatrix(5, 3, 9);
  EXPECT_EQ(messageOf([&] { msi::fitRModel(estimated, estimated); }),
    "the R-model has 3 tuning samples for 4 unknowns a band; expected at least 4 samples");
  EXPECT_EQ(messageOf([&] { msi::fitRModel(estimated, randomMatrix(5, 4, 9)); }),
    "estimated reflectance is 5 bands x 3 samples but measured reflectance is 5 x 4; expected the "
    "same shape");
  EXPECT_EQ(messageOf([&] { msi::fitRModel(estimated * NaN, estimated); }),
    "estimated reflectance sample 1, band 1 is nan; expected a finite number");
}

}

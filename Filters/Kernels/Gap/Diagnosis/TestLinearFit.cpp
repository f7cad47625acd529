#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/LinearFit.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace msi;

class Described : public ObservedFit
{
};

NormalEquations equations(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& gradient)
{
  return { matrix.sparseView(), gradient };
}

FreeNumber common(double deviation, double lower, double upper)
{
  FreeNumber number;
  number.deviation = deviation;
  number.lower = lower;
  number.upper = upper;
  return number;
}

const double Wide = std::pow(Decision::FreeSpread, -2); // of a number of typical size 1
}

// n values of a constant: their sum over n, less what the prior holds back.
TEST(LinearFit, AMeanIsThatOfTheData)
{
  FreeNumber number;
  const LinearFit fit({ number },
    { equations(Eigen::MatrixXd::Constant(1, 1, 3.0), Eigen::VectorXd::Constant(1, 6.0)),
      equations(Eigen::MatrixXd::Constant(1, 1, 2.0), Eigen::VectorXd::Constant(1, 1.0)) },
    false);
  EXPECT_NEAR(fit.step()[0], 7.0 / (5.0 + Wide), 1e-11);
  EXPECT_NEAR(fit.stepsWithout()[0][0], 1.0 / (2.0 + Wide), 1e-11);
  EXPECT_NEAR(fit.stepsWithout()[1][0], 6.0 / (3.0 + Wide), 1e-11);
  EXPECT_NEAR(fit.step(1.0)[0], 7.0 / (2.0 * (5.0 + Wide)), 1e-11);
  EXPECT_NEAR(fit.penalty(Eigen::VectorXd::Constant(1, 2.0)), 4.0 * Wide, 1e-15);
}

// Residuals with a variance of 4 hold a number four times less against its prior; information and error are those of the data.
TEST(LinearFit, DataCountLessWithTheirDispersion)
{
  FreeNumber number;
  const LinearFit fit({ number },
    { equations(Eigen::MatrixXd::Constant(1, 1, 5.0), Eigen::VectorXd::Constant(1, 7.0)) }, false,
    4.0);
  EXPECT_NEAR(fit.step()[0], 7.0 / (5.0 + 4.0 * Wide), 1e-11);
  EXPECT_NEAR(fit.information().coeff(0, 0), 5.0, 1e-11);
  EXPECT_NEAR(fit.penalty(Eigen::VectorXd::Constant(1, 2.0)), 16.0 * Wide, 1e-14);
  const Eigen::RowVectorXd scores = Eigen::RowVector4d(2.0, -2.0, 2.0, -2.0);
  EXPECT_NEAR(
    fit.covariance(scores)(0, 0), 16.0 / std::pow(5.0 + 4.0 * Wide, 2) * 4.0 / 3.0, 1e-11);
}

// Without data a number goes where its prior wants it.
TEST(LinearFit, WithoutDataThePriorDecides)
{
  FreeNumber number;
  number.deviation = 0.3;
  number.wanted = 0.1;
  const LinearFit fit(
    { number }, { equations(Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Zero(1)) }, false);
  EXPECT_NEAR(fit.step()[0], -0.2, 1e-11);
  EXPECT_EQ(LinearFit().step().size(), 0);
}

// x^2 + y^2 + x y - 3 x - 3 y has its least value at (1, 1); where x may not pass .4 at y = 1.3.
TEST(LinearFit, BeyondABoundTheOthersAreSolvedForAgain)
{
  Eigen::Matrix2d matrix;
  matrix << 2.0, 1.0, 1.0, 2.0;
  matrix *= 1e6; // the prior counts nothing
  const LinearFit fit({ common(0.1, -1.0, 0.4), common(0.0, -9.0, 9.0) },
    { equations(matrix, 1e6 * Eigen::Vector2d(2.8, 2.9)) }, false);
  const Eigen::VectorXd step = fit.step();
  EXPECT_NEAR(step[0], 0.3, 1e-11);
  EXPECT_NEAR(step[1], 1.3, 1e-6);
  Described description;
  fit.describe(description);
  EXPECT_FALSE(description.atBound);
  fit.describe(description, step);
  EXPECT_TRUE(description.atBound);
  EXPECT_NEAR(description.surprise, std::log1p(0.16) + std::log1p(1.69), 1e-5);
}

// A number that cannot be negative is none where it is zero; at its other end it says that something is wrong.
TEST(LinearFit, AnEndThatIsNeutralIsNoEnd)
{
  for (const double end : { 0.0, 0.4 })
  {
    const LinearFit fit({ common(end, 0.0, 0.4) },
      { equations(Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Zero(1)) }, false);
    Described description;
    fit.describe(description);
    EXPECT_EQ(description.atBound, end > 0.0);
  }
}

// Where the fit has settled leaving out nothing changes nothing, and leaving out a fold takes its own pull away.
TEST(LinearFit, ASettledFitStays)
{
  FreeNumber number;
  number.deviation = 0.5;
  const NormalEquations one =
    equations(Eigen::MatrixXd::Constant(1, 1, 4.0), Eigen::VectorXd::Constant(1, 1.0));
  LinearFit fit({ number }, { one, one }, false);
  fit.settle();
  EXPECT_NEAR(fit.step()[0], 0.0, 1e-15);
  EXPECT_NEAR(fit.stepsWithout()[0][0], -1.0 / (4.0 + Wide), 1e-11);
}

// Numbers +-d, known exactly: beside another effect their variance is d^2, alone the prior stays wide.
TEST(LinearFit, NumbersOfChannelsLearnTheirVarianceBesideOthers)
{
  FreeNumber up;
  up.perChannel = true;
  up.deviation = 0.2;
  FreeNumber down = up;
  down.deviation = -0.2;
  const NormalEquations exact =
    equations(1e9 * Eigen::MatrixXd::Identity(2, 2), Eigen::VectorXd::Zero(2));
  EXPECT_NEAR(LinearFit({ up, down }, { exact }, true).prior().blocks()[0].variance, 0.04, 1e-6);
  EXPECT_NEAR(
    LinearFit({ up, down }, { exact }, false).prior().blocks()[0].variance, 1.0 / Wide, 1e-9);
}

// Several channels with one number and an effect that is common to them, against dense matrices: numbers that learn their variance about
// a mean of their own.
TEST(LinearFit, MeansCarriedAlongAreAsGoodAsDenseMatrices)
{
  constexpr Eigen::Index Count = 7;
  std::vector<FreeNumber> numbers;
  for (Eigen::Index n = 0; n <= Count; ++n)
  {
    FreeNumber number;
    number.group = n < Count ? 0 : 1;
    number.perChannel = n < Count;
    number.ownMean = number.perChannel;
    number.deviation = 0.1 + 0.03 * static_cast<double>(n % 3);
    numbers.push_back(number);
  }
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(Count + 1, Count + 1);
  matrix.diagonal().setLinSpaced(40.0, 90.0);
  matrix.col(Count).head(Count).setLinSpaced(-9.0, 4.0);
  matrix.row(Count) = matrix.col(Count).transpose();
  const Eigen::VectorXd gradient = Eigen::VectorXd::LinSpaced(Count + 1, 1.0, -3.0);
  const LinearFit fit(numbers, { equations(matrix, gradient) }, true);

  const PriorBlock& block = fit.prior().blocks().front();
  ASSERT_EQ(block.size, Count);
  EXPECT_NEAR(block.ofMean, 1.0 / Wide, 1e-9);
  EXPECT_LT(block.variance, 0.1);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(Count + 1, Count + 1);
  covariance.topLeftCorner(Count, Count).setConstant(block.ofMean);
  covariance.diagonal().head(Count).array() += block.variance;
  covariance(Count, Count) = 1.0 / Wide;
  const Eigen::MatrixXd precision = covariance.inverse();
  Eigen::VectorXd off(Count + 1);
  for (Eigen::Index n = 0; n <= Count; ++n)
  {
    off[n] = -numbers[static_cast<std::size_t>(n)].deviation;
  }
  const Eigen::MatrixXd inverse = (matrix + precision).inverse();
  const Eigen::VectorXd step = inverse * (gradient + precision * off);
  EXPECT_LT((fit.step() - step).norm(), 1e-11 * step.norm());
  const Eigen::VectorXd left = step - off;
  EXPECT_NEAR(fit.penalty(step), left.dot(precision * left), 1e-11);
  EXPECT_LT(
    (diagonalOfInverse(fit.prior().after(matrix.sparseView())).head(Count + 1) - inverse.diagonal())
      .norm(),
    1e-11);
  const Eigen::MatrixXd told =
    Eigen::MatrixXd::Identity(Count + 1, Count + 1) + covariance * matrix;
  EXPECT_NEAR(fit.prior().gain(matrix.sparseView()), 0.5 * std::log(told.determinant()), 1e-10);
}

// One number, n groups with scores +-s: s^2 n / information^2 n / (n - 1).
TEST(LinearFit, CovarianceIsTheSandwich)
{
  FreeNumber number;
  const LinearFit fit({ number },
    { equations(Eigen::MatrixXd::Constant(1, 1, 10.0), Eigen::VectorXd::Zero(1)) }, false);
  const Eigen::RowVectorXd scores = Eigen::RowVector4d(2.0, -2.0, 2.0, -2.0);
  EXPECT_NEAR(fit.covariance(scores)(0, 0), 16.0 / std::pow(10.0 + Wide, 2) * 4.0 / 3.0, 1e-11);
}

#include "Kernels/Numerics/NonNegativeLeastSquares.h"
#include "Kernels/Numerics/NumericsTestData.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

// Expected values: scipy.optimize.nnls 1.10 on the same numbers. The last column is zero: a singular system.
TEST(NonNegativeLeastSquares, AgreesWithAnotherProgram)
{
  Eigen::MatrixXd a(8, 5);
  Eigen::VectorXd b(8);
  for (int i = 0; i < 8; ++i)
  {
    for (int j = 0; j < 5; ++j)
    {
      a(i, j) = (7 * i + 3 * j * j + i * j) % 11 - 4;
    }
    b[i] = (5 * i * i + 2) % 13 - 5;
  }
  const auto solution = msi::solveNonNegative(a.transpose() * a, a.transpose() * b);
  EXPECT_TRUE(solution.converged);
  const Eigen::VectorXd expected =
    (Eigen::VectorXd(5) << 0.0, 0.49589334603023455, 0.37626473038923935, 0.0, 0.0).finished();
  EXPECT_LT((solution.x - expected).norm(), 1e-13);
}

// Karush-Kuhn-Tucker: no gradient where positive, none downhill where zero.
TEST(NonNegativeLeastSquares, MeetsTheOptimalityConditions)
{
  const msi::CounterRandom random(4);
  for (std::uint64_t problem = 0; problem < 50; ++problem)
  {
    Eigen::MatrixXd a(25, 18);
    Eigen::VectorXd b(25);
    for (Eigen::Index i = 0; i < 25; ++i)
    {
      for (Eigen::Index j = 0; j < 18; ++j)
      {
        a(i, j) = random.normal(problem * 1000 + static_cast<std::uint64_t>(18 * i + j));
      }
      b[i] = random.normal(problem * 1000 + 900 + static_cast<std::uint64_t>(i));
    }
    const Eigen::MatrixXd h = a.transpose() * a;
    const Eigen::VectorXd f = a.transpose() * b;
    const auto solution = msi::solveNonNegative(h, f);
    ASSERT_TRUE(solution.converged);
    const Eigen::VectorXd gradient = f - h * solution.x;
    for (Eigen::Index j = 0; j < 18; ++j)
    {
      ASSERT_GE(solution.x[j], 0.0);
      ASSERT_LE(gradient[j], 1e-9);
      ASSERT_LE(solution.x[j] * std::abs(gradient[j]), 1e-9);
    }
  }
}

// Broad passbands that overlap: who takes all coefficients away at once that want to be negative goes round in circles.
TEST(NonNegativeLeastSquares, ConvergesWhereColumnsAreAlike)
{
  constexpr Eigen::Index Columns = 18;
  constexpr Eigen::Index Rows = 25;
  constexpr double Width = 8.0; // columns
  const msi::CounterRandom random(4);
  Eigen::MatrixXd a(Rows, Columns);
  for (Eigen::Index i = 0; i < Rows; ++i)
  {
    const double place = static_cast<double>(i * Columns) / static_cast<double>(Rows);
    a.row(i) =
      (-((Eigen::ArrayXd::LinSpaced(Columns, 0.0, Columns - 1.0) - place) / Width).square())
        .exp()
        .matrix()
        .transpose();
  }
  const Eigen::MatrixXd h = a.transpose() * a;
  for (std::uint64_t problem = 0; problem < 200; ++problem)
  {
    Eigen::VectorXd b(Rows);
    for (Eigen::Index i = 0; i < Rows; ++i)
    {
      b[i] = std::sin(0.5 * static_cast<double>(i) + static_cast<double>(problem)) +
        random.normal(problem * 1000 + static_cast<std::uint64_t>(i));
    }
    const Eigen::VectorXd f = a.transpose() * b;
    const auto solution = msi::solveNonNegative(h, f);
    ASSERT_TRUE(solution.converged) << problem;
    ASSERT_GE(solution.x.minCoeff(), 0.0);
    const Eigen::ArrayXd gradient = f - h * solution.x;
    ASSERT_LE(gradient.maxCoeff(), 1e-7) << problem;
    ASSERT_LE((solution.x.array() * gradient).abs().maxCoeff(), 1e-7) << problem;
  }
}

TEST(NonNegativeLeastSquares, RefusesShapesThatDisagree)
{
  EXPECT_EQ(msi::test::messageOf(
              [] { msi::solveNonNegative(Eigen::MatrixXd::Zero(3, 2), Eigen::VectorXd::Zero(3)); }),
    "non-negative least squares has a matrix of 3 x 2 and a right side of 3");
}

}

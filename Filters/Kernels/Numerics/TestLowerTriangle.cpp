#include "Kernels/Numerics/LowerTriangle.h"

#include "Kernels/Numerics/NumericsTestData.h"

#include <Eigen/Cholesky>

#include <gtest/gtest.h>

#include <limits>

namespace
{
// Positive definite, above the diagonal what must not be read.
Eigen::MatrixXd lowerOfPositive(Eigen::Index size)
{
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(size, size);
  Eigen::MatrixXd matrix = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
  matrix.triangularView<Eigen::StrictlyUpper>().setConstant(
    std::numeric_limits<double>::quiet_NaN());
  return matrix;
}

struct Inverted
{
  Eigen::MatrixXd inverse;
  Eigen::VectorXd diagonal;
};

Inverted inverted(const Eigen::MatrixXd& matrix)
{
  Inverted result{ matrix, Eigen::VectorXd(matrix.rows()) };
  Eigen::MatrixXd work(matrix.rows(), matrix.rows());
  EXPECT_TRUE(msi::invertFactor(result.inverse, result.diagonal, work));
  return result;
}

// All products with one lower triangle, side by side.
Eigen::MatrixXd products(const Eigen::MatrixXd& lower)
{
  const Eigen::Index size = lower.rows();
  const Eigen::MatrixXd a = Eigen::MatrixXd::Constant(5, size, 0.25) +
    Eigen::RowVectorXd::LinSpaced(size, -1.0, 1.0).replicate(5, 1);
  Eigen::MatrixXd times = Eigen::MatrixXd::Ones(5, size);
  msi::addTimesLower(times, a, lower);
  Eigen::MatrixXd timesTransposed = Eigen::MatrixXd::Ones(5, size);
  msi::addTimesTransposedLower(timesTransposed, a, lower);
  Eigen::MatrixXd outer = Eigen::MatrixXd::Ones(size, size);
  msi::addOuterProduct(outer, a.transpose(), 2.0 * a.transpose());
  Eigen::MatrixXd square = Eigen::MatrixXd::Ones(size, size);
  Eigen::MatrixXd work(size, size);
  msi::addSquare(square, lower, work);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size, 2 * size + 10);
  all.leftCols(size).triangularView<Eigen::Lower>() = outer;
  all.middleCols(size, size).triangularView<Eigen::Lower>() = square;
  all.rightCols(10) << times.transpose(), timesTransposed.transpose();
  return all;
}

class InverseFactor : public testing::TestWithParam<Eigen::Index>
{
};

TEST_P(InverseFactor, IsThatOfEigen)
{
  const Eigen::Index size = GetParam();
  const Eigen::MatrixXd matrix = lowerOfPositive(size);
  const Inverted result = inverted(matrix);
  const Eigen::MatrixXd factor = Eigen::LLT<Eigen::MatrixXd>(matrix).matrixL();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(size, size);
  EXPECT_LT((result.inverse * factor - identity).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((result.diagonal - factor.diagonal()).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(Eigen::MatrixXd(result.inverse.triangularView<Eigen::StrictlyUpper>()).norm(), 0.0);
}

TEST_P(InverseFactor, ProductsAreThoseOfEigen)
{
  const Eigen::Index size = GetParam();
  const Eigen::MatrixXd lower = inverted(lowerOfPositive(size)).inverse;
  const Eigen::MatrixXd a = Eigen::MatrixXd::Constant(5, size, 0.25) +
    Eigen::RowVectorXd::LinSpaced(size, -1.0, 1.0).replicate(5, 1);
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(size, size);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(size, 2 * size + 10);
  expected.leftCols(size).triangularView<Eigen::Lower>() = ones + 2.0 * a.transpose() * a;
  expected.middleCols(size, size).triangularView<Eigen::Lower>() = ones + lower.transpose() * lower;
  expected.rightCols(10) << (a * lower).transpose(), (a * lower.transpose()).transpose();
  expected.rightCols(10).array() += 1.0;
  const double scale = expected.cwiseAbs().maxCoeff();
  EXPECT_LT((products(lower) - expected).cwiseAbs().maxCoeff(), 1e-13 * scale);
}

TEST_P(InverseFactor, HasTheSameBytesOnEveryInstructionSet)
{
  const Eigen::MatrixXd matrix = lowerOfPositive(GetParam());
  const Inverted expected = inverted(matrix);
  const Eigen::MatrixXd expectedProducts = products(expected.inverse);
  msi::test::withLesserInstructionSets(
    [&]
    {
      const Inverted found = inverted(matrix);
      EXPECT_EQ(found.inverse, expected.inverse);
      EXPECT_EQ(found.diagonal, expected.diagonal);
      EXPECT_EQ(products(found.inverse), expectedProducts);
    });
}

INSTANTIATE_TEST_SUITE_P(Sizes, InverseFactor, testing::Values(1, 2, 31, 32, 33, 64, 97, 156));

TEST(InverseFactorOf, WhatIsNotPositiveHasNone)
{
  for (const Eigen::Index size : { 3, 40, 100 })
  {
    Eigen::MatrixXd matrix = lowerOfPositive(size);
    matrix(size - 1, size - 1) = -1.0;
    Eigen::VectorXd diagonal(size);
    Eigen::MatrixXd work(size, size);
    EXPECT_FALSE(msi::invertFactor(matrix, diagonal, work)) << size;
  }
}
}

#include "Kernels/Gap/Samples/ColumnProducts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
TEST(ColumnProducts, AreTheMatrixProductForAnyNumberOfRowsAndColumns)
{
  for (const Eigen::Index rows : { 0, 1, 7, 8, 9, 200, 203 })
  {
    for (const Eigen::Index columns : { 1, 2, 3, 6 })
    {
      const Eigen::MatrixXd left = Eigen::MatrixXd::Random(rows, columns);
      const Eigen::MatrixXd right = Eigen::MatrixXd::Random(rows, columns + 1);
      const Eigen::MatrixXd expected = left.transpose() * right;
      EXPECT_TRUE(msi::columnProducts(left, right).isApprox(expected, 1e-13) || rows == 0)
        << rows << " x " << columns;
      EXPECT_EQ(msi::columnProducts(left, right).rows(), columns);
      EXPECT_EQ(msi::columnProducts(left, right).cols(), columns + 1);
    }
  }
}

TEST(ColumnProducts, SumInAnOrderThatDependsOnNothingElse)
{
  const Eigen::MatrixXd left = Eigen::MatrixXd::Random(75, 3);
  const Eigen::MatrixXd products = msi::columnProducts(left, left);
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    for (Eigen::Index b = 0; b < 3; ++b)
    {
      Eigen::Array<double, 8, 1> sums = Eigen::Array<double, 8, 1>::Zero();
      for (Eigen::Index i = 0; i < 75; ++i)
      {
        sums[i % 8] += left(i, a) * left(i, b);
      }
      double expected = 0.0;
      for (const double sum : sums)
      {
        expected += sum;
      }
      EXPECT_EQ(products(a, b), expected);
    }
  }
}

TEST(ColumnProducts, OfOneMatrixAreTheSameBits)
{
  for (const Eigen::Index columns : { 1, 4, 7, 18 })
  {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(75, columns);
    EXPECT_EQ(msi::columnProducts(matrix), msi::columnProducts(matrix, matrix)) << columns;
  }
}

TEST(ColumnProducts, TakeBlocksOfLargerMatrices)
{
  const Eigen::MatrixXd whole = Eigen::MatrixXd::Random(40, 6);
  const auto block = whole.block(3, 1, 20, 4);
  EXPECT_EQ(msi::columnProducts(block, block),
    msi::columnProducts(Eigen::MatrixXd(block), Eigen::MatrixXd(block)));
}
}

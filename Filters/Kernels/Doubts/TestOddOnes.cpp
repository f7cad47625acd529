#include "Kernels/Doubts/OddOnes.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
constexpr Eigen::Index Rows = 16;

// Every element 1 or 2 in turn, a kind for each row.
Eigen::MatrixXd usual(Eigen::Index groups)
{
  Eigen::MatrixXd left(Rows, groups);
  for (Eigen::Index e = 0; e < left.size(); ++e)
  {
    left(e) = e % 3 == 0 ? 2.0 : 1.0;
  }
  return left;
}

Eigen::MatrixXi rowNumbers(Eigen::Index groups)
{
  return Eigen::VectorXi::LinSpaced(Rows, 0, Rows - 1).replicate(1, groups);
}

TEST(OddElements, SingleOnes)
{
  Eigen::MatrixXd left = usual(40);
  left(3, 5) = 900.0;
  left(7, 20) = 1500.0;
  left.col(30).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(
    msi::oddElements(left, rowNumbers(40)), (msi::IndexList{ 5 * Rows + 3, 20 * Rows + 7 }));
  EXPECT_TRUE(msi::oddElements(usual(40), rowNumbers(40)).empty());
}

// What a whole channel leaves is usual there, even if nothing else does.
TEST(OddElements, AreComparedWithTheirKind)
{
  Eigen::MatrixXd left = usual(40);
  left.row(4) *= 1000.0;
  EXPECT_TRUE(msi::oddElements(left, rowNumbers(40)).empty());
  EXPECT_FALSE(msi::oddElements(left, Eigen::MatrixXi::Zero(Rows, 40)).empty());
}

// Of a group of which a third stands out, every element.
TEST(OddElements, WholeGroups)
{
  Eigen::MatrixXd left = usual(40);
  left.col(5).head(6).setConstant(900.0);
  msi::IndexList expected;
  for (Eigen::Index e = 0; e < Rows; ++e)
  {
    expected.push_back(5 * Rows + e);
  }
  EXPECT_EQ(msi::oddElements(left, rowNumbers(40)), expected);
}

// More than an eighth are not few.
TEST(OddElements, ManyAreNotOdd)
{
  Eigen::MatrixXd left = usual(40);
  left.leftCols(8).topRows(3).setConstant(900.0);
  const Eigen::MatrixXi one = Eigen::MatrixXi::Zero(Rows, 40);
  EXPECT_EQ(msi::oddElements(left, one).size(), 24U);
  EXPECT_TRUE(msi::oddElements(left, one, 100).empty());
}
}

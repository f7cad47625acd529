#include "Kernels/Gap/GapCertainty.h"

#include <gtest/gtest.h>

namespace
{

Eigen::MatrixXd productsOf(const Eigen::MatrixXd& causes)
{
  Eigen::MatrixXd columns(causes.rows(), causes.cols() + 1);
  columns << causes, causes.rowwise().sum();
  return columns.transpose() * columns;
}

TEST(GapCertainty, WhatIsLeftMayOverlapByItsOwnSize)
{
  EXPECT_DOUBLE_EQ(msi::certainPart(1.0), 1.0);
  EXPECT_DOUBLE_EQ(msi::certainPart(0.9), 0.9 * 0.8);
  EXPECT_DOUBLE_EQ(msi::certainPart(0.5), 0.5 * 0.2);
  EXPECT_DOUBLE_EQ(msi::certainPart(0.0), 0.0);
}

TEST(GapCertainty, DoubtNeedsARest)
{
  EXPECT_DOUBLE_EQ(msi::doubtOf({ 0.8, 1.0 }), 0.0);
  EXPECT_NEAR(msi::doubtOf({ 0.8, 0.98 }), 0.4, 1e-12);
  EXPECT_DOUBLE_EQ(msi::doubtOf({ 0.5, 0.9 }), 1.0);
}

// Two causes at an obtuse angle a: the larger reaches -cos a of the smaller, the smaller only as far as its own size.
TEST(GapCertainty, CausesThatPointAtOneAnotherUndoEachOther)
{
  Eigen::MatrixXd causes(2, 2);
  causes << 3.0, -1.0, //
    0.0, 1.0;
  const std::vector<double> undone = msi::undoneParts(productsOf(causes));
  ASSERT_EQ(undone.size(), 2U);
  EXPECT_NEAR(undone[0], 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(undone[1], 0.5, 1e-12);
}

TEST(GapCertainty, CausesThatGoTogetherUndoNothing)
{
  Eigen::MatrixXd causes(2, 3);
  causes << 1.0, 0.5, 0.0, //
    0.0, 0.5, 1.0;
  for (const double undone : msi::undoneParts(productsOf(causes)))
  {
    EXPECT_EQ(undone, 0.0);
  }
  EXPECT_EQ(msi::undoneParts(productsOf(Eigen::MatrixXd::Ones(4, 1))).front(), 0.0);
}

} // namespace

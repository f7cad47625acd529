#include "Kernels/Gap/Samples/GapEvidence.h"
#include "Kernels/Gap/Samples/GapTestData.h"

#include <gtest/gtest.h>

namespace
{

using namespace msi::test;

// 7 channels x 96 samples; sums over wavelength may err by 0.001.
class Evidence : public ::testing::Test
{
protected:
  Evidence()
    : Data(dataOf(captureWith({})))
    , Integration(Eigen::MatrixXd::Constant(7, 96, 1e-6))
    , None(Eigen::MatrixXd::Zero(7, 96))
  {
  }
  Eigen::MatrixXd inSamples(int count, double gap) const
  {
    Eigen::MatrixXd change = None;
    change.leftCols(count).setConstant(gap);
    return change;
  }
  msi::GapData Data;
  Eigen::MatrixXd Integration;
  Eigen::MatrixXd None;
};

TEST_F(Evidence, SumsOverWavelengthMayBeOffByTwiceTheirVarianceEverywhere)
{
  EXPECT_LT(noticed(Data, inSamples(96, 0.0014), None, Integration), 1.0);
  EXPECT_GT(noticed(Data, inSamples(96, 0.0015), None, Integration), 1.0);
}

// 3 samples of 0.006: on average a tenth of 2e-6 less, but 18 times that in these samples.
TEST_F(Evidence, TheyAreNotOffInThreeSamplesAlone)
{
  EXPECT_GT(noticed(Data, inSamples(3, 0.006), None, Integration), 1.0);
  EXPECT_LT(noticed(Data, inSamples(3, 0.0015), None, Integration), 1.0);
}

TEST_F(Evidence, WhatIsLeftMustNotBeMuchMore)
{
  EXPECT_LT(noticed(Data, inSamples(96, 0.0108), inSamples(96, 0.01), Integration), 1.0);
  EXPECT_GT(noticed(Data, inSamples(96, 0.0115), inSamples(96, 0.01), Integration), 1.0);
}

TEST_F(Evidence, NothingIsNoticedOfWhatMakesTheGapLarger)
{
  EXPECT_EQ(noticed(Data, None, inSamples(96, 0.01), Integration), 0.0);
  EXPECT_NEAR(noticed(Data, inSamples(96, 0.001), None, Integration), 0.5, 1e-12);
}

TEST_F(Evidence, FewSamplesAreThree)
{
  EXPECT_TRUE(inFewSamples(Data, inSamples(3, 0.02)));
  EXPECT_FALSE(inFewSamples(Data, inSamples(4, 0.02)));
  EXPECT_FALSE(inFewSamples(Data, inSamples(96, 0.02)));
}

} // namespace

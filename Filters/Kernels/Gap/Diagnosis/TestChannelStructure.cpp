#include "Kernels/Gap/Diagnosis/ChannelStructure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

// Closed forms: Beta(1, b) has the tail (1 - x)^b, Beta(1/2, 1/2) is the arcsine law.
TEST(ChannelStructure, ChanceHasItsClosedForms)
{
  EXPECT_NEAR(msi::chanceOfFraction(0.7, 2, 8), std::pow(0.3, 3.0), 1e-6);
  EXPECT_NEAR(msi::chanceOfFraction(0.9, 2, 6), std::pow(0.1, 2.0), 1e-6);
  EXPECT_NEAR(msi::chanceOfFraction(0.5, 1, 2),
    1.0 - 2.0 / 3.14159265358979 * std::asin(std::sqrt(0.5)), 1e-6);
  EXPECT_EQ(msi::chanceOfFraction(0.0, 2, 8), 1.0);
  EXPECT_EQ(msi::chanceOfFraction(0.9, 3, 3), 1.0);
}

TEST(ChannelStructure, CurvesOverTheChannelsAreCommonAlternationIsNot)
{
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(12, 0.0, 1.0);
  EXPECT_NEAR(
    msi::commonFraction((0.02 + 0.1 * x - 0.3 * x.square() + x.cube()).matrix()), 1.0, 1e-12);
  Eigen::VectorXd alternating(12);
  alternating << 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1;
  EXPECT_LT(msi::commonFraction(alternating), 0.1);
  EXPECT_EQ(msi::commonFraction(Eigen::VectorXd::Zero(12)), 0.0);
  EXPECT_EQ(msi::commonFraction(Eigen::VectorXd::Ones(4)), 0.0);
}

} // namespace

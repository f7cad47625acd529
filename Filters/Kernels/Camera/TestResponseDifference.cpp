#include "Kernels/Camera/ResponseDifference.h"

#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace msi;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

TEST(ResponseDifference, FindsGainAndOffset)
{
  const Eigen::MatrixXd simulated = Eigen::RowVector4d(0.0, 0.25, 0.5, 1.0);
  const auto d = responseDifference(2.0 * simulated.array() + 0.125, simulated).at(0);
  EXPECT_EQ(d.samples, 4);
  EXPECT_DOUBLE_EQ(d.gain, 2.0);
  EXPECT_DOUBLE_EQ(d.offset, 0.125);
  EXPECT_NEAR(d.rmsAroundLine, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(d.mean, 0.4375 + 0.125);
  // Differences .125, .375, .625, 1.125.
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt((0.015625 + 0.140625 + 0.390625 + 1.265625) / 4.0));
}

TEST(ResponseDifference, LeavesOutWhatWasNotMeasured)
{
  Eigen::MatrixXd real(3, 3);
  real << 1.0, NaN, 3.0, NaN, NaN, NaN, 1.0, 2.0, 3.0;
  const auto d = responseDifference(real, Eigen::MatrixXd::Ones(3, 3));
  EXPECT_EQ(d[0].samples, 2);
  EXPECT_DOUBLE_EQ(d[0].mean, 1.0);
  EXPECT_TRUE(std::isnan(d[0].gain));
  EXPECT_EQ(d[1].samples, 0);
  EXPECT_TRUE(std::isnan(d[1].rms));
  EXPECT_DOUBLE_EQ(d[2].mean, 1.0);
}

TEST(ResponseDifference, NamesBothShapes)
{
  EXPECT_EQ(
    test::messageOf([] { responseDifference(Eigen::MatrixXd(2, 3), Eigen::MatrixXd(2, 4)); }),
    "the real camera has 2 channels and 3 samples, the simulated one 2 and 4; expected the same");
}
}

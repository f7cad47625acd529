#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/Imaging/ImageSimulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{
using msi::CameraEffect;

// Five channels that report five wavelengths, captured at the times 0, 1/4, .., 1.
msi::WavelengthGrid fiveBands()
{
  return msi::WavelengthGrid::uniform(450.0, 650.0, 50.0);
}

Eigen::MatrixXd respondTo(const Eigen::MatrixXd& reflectance, const CameraEffect& effect)
{
  const msi::CameraModel identity(
    fiveBands(), Eigen::MatrixXd::Identity(5, 5), Eigen::VectorXd::Zero(5));
  msi::SceneSamples samples;
  samples.reflectance = reflectance;
  samples.order = Eigen::VectorXd::LinSpaced(reflectance.cols(), 10.0, 20.0);
  return msi::CameraSimulator(identity, { effect }).respond({ fiveBands(), samples });
}

double respondToFlat(double u, const CameraEffect& effect)
{
  return respondTo(Eigen::MatrixXd::Constant(5, 1, u), effect)(2, 0);
}

TEST(ExposureGain, IsAFactor)
{
  EXPECT_NEAR(respondToFlat(0.5, { "exposure_gain", "", "", { 1.1 } }), 0.55, 1e-15);
}

TEST(ChannelGain, IsAFactorOfEachChannel)
{
  const Eigen::MatrixXd u = respondTo(
    Eigen::MatrixXd::Constant(5, 2, 0.5), { "channel_gain", "", "", { 0.8, 0.9, 1.0, 1.1, 1.2 } });
  for (int k = 0; k < 5; ++k)
  {
    EXPECT_NEAR(u(k, 1), 0.5 * (0.8 + 0.1 * k), 1e-15);
  }
}

TEST(ChannelCrosstalk, ExchangesLightBetweenNeighbours)
{
  Eigen::MatrixXd impulse = Eigen::MatrixXd::Zero(5, 1);
  impulse(2, 0) = 1.0;
  const Eigen::MatrixXd u = respondTo(impulse, { "channel_crosstalk", "", "", { 0.1, 0.0 } });
  EXPECT_LT((u - (Eigen::MatrixXd(5, 1) << 0.0, 0.1, 0.8, 0.1, 0.0).finished()).norm(), 1e-15);
  const Eigen::MatrixXd sided =
    respondTo(impulse, { "channel_crosstalk", "one_sided", "", { 0.1, 0.05 } });
  EXPECT_LT(
    (sided - (Eigen::MatrixXd(5, 1) << 0.0, 0.05, 0.85, 0.1, 0.0).finished()).norm(), 1e-15);
  // What one channel loses its neighbours gain, at the ends too.
  const Eigen::MatrixXd ramp = Eigen::VectorXd::LinSpaced(5, 0.1, 0.9);
  EXPECT_NEAR(
    respondTo(ramp, { "channel_crosstalk", "", "", { 0.1, 0.0 } }).sum(), ramp.sum(), 1e-14);
}

// The mean of the impulse is 1 / 5.
TEST(ChannelCrosstalk, SharedItGivesEachAPartOfTheMean)
{
  Eigen::MatrixXd impulse = Eigen::MatrixXd::Zero(5, 1);
  impulse(2, 0) = 1.0;
  const Eigen::MatrixXd u = respondTo(impulse, { "channel_crosstalk", "shared", "", { 0.1 } });
  EXPECT_LT((u - (Eigen::MatrixXd(5, 1) << 0.02, 0.02, 0.92, 0.02, 0.02).finished()).norm(), 1e-15);
}

// Channels 0 to 4 stand at -1, -1/2, 0, 1/2, 1.
TEST(ChannelCrosstalk, GrowsOverTheChannels)
{
  const Eigen::MatrixXd ramp = Eigen::VectorXd::LinSpaced(5, 0.1, 0.9);
  const Eigen::MatrixXd u = respondTo(ramp, { "channel_crosstalk", "", "", { 0.1, 0.6 } });
  EXPECT_NEAR(u(0, 0), 0.1 + 0.1 * (1.0 - 0.6) * 0.2, 1e-15);
  EXPECT_NEAR(u(2, 0), 0.5, 1e-15);
  EXPECT_NEAR(u(4, 0), 0.9 - 0.1 * (1.0 + 0.6) * 0.2, 1e-15);
}

TEST(DetectorNonlinearity, FollowsItsFormula)
{
  EXPECT_NEAR(respondToFlat(0.5, { "detector_nonlinearity", "", "", { -0.2 } }), 0.5 - 0.05, 1e-15);
  const CameraEffect anchored{ "detector_nonlinearity", "anchored", "", { -0.2 } };
  EXPECT_NEAR(respondToFlat(1.0, anchored), 1.0, 1e-15);
  EXPECT_NEAR(respondToFlat(0.5, anchored), 0.6 - 0.05, 1e-15);
  const CameraEffect gamma{ "detector_nonlinearity", "gamma", "", { 1.2 } };
  EXPECT_NEAR(respondToFlat(0.3, gamma), std::pow(0.3, 1.2), 1e-15);
  EXPECT_EQ(respondToFlat(-0.01, gamma), -0.01);
  EXPECT_NEAR(
    respondToFlat(0.5, { "detector_nonlinearity", "compressive", "", { 0.3 } }), 0.5 / 1.15, 1e-15);
  EXPECT_NEAR(respondToFlat(0.5, { "detector_nonlinearity", "cubic", "", { 0.2, -0.1 } }),
    0.5 + 0.05 - 0.0125, 1e-15);
}

TEST(DetectorNonlinearity, OfEachChannelKeepsWhite)
{
  const CameraEffect curves{ "detector_nonlinearity", "per_channel", "",
    { -0.2, -0.1, 0.0, 0.1, 0.2 } };
  EXPECT_LT((respondTo(Eigen::MatrixXd::Ones(5, 1), curves).array() - 1.0).abs().maxCoeff(), 1e-15);
  const Eigen::MatrixXd half = respondTo(Eigen::MatrixXd::Constant(5, 1, 0.5), curves);
  for (int k = 0; k < 5; ++k)
  {
    EXPECT_NEAR(half(k, 0), 0.5 - 0.25 * 0.1 * (k - 2), 1e-15);
  }
}

TEST(DarkOffset, IsAddedAfterTheCurve)
{
  EXPECT_NEAR(respondToFlat(0.5, { "dark_offset", "", "", { 0.01 } }), 0.51, 1e-15);
  const Eigen::MatrixXd each = respondTo(Eigen::MatrixXd::Zero(5, 1),
    { "dark_offset", "per_channel", "", { 0.0, 0.01, 0.02, 0.03, 0.04 } });
  EXPECT_NEAR(each(3, 0), 0.03, 1e-15);
}

TEST(Saturation, RoundsTheCornerOfTheMinimum)
{
  const CameraEffect effect{ "saturation", "", "", { 0.8, 0.01 } };
  EXPECT_NEAR(respondToFlat(0.8, effect), 0.8 - 0.005, 1e-15);
  // A hyperbola: softness^2 / 4 over the distance from the corner.
  EXPECT_NEAR(respondToFlat(0.4, effect), 0.4 - 0.0001 / 4.0 / 0.4, 1e-7);
  EXPECT_NEAR(respondToFlat(1.6, effect), 0.8 - 0.0001 / 4.0 / 0.8, 1e-7);
}

TEST(Saturation, OfEachChannelIsAtALevelOfItsOwn)
{
  const Eigen::MatrixXd u = respondTo(Eigen::MatrixXd::Constant(5, 1, 0.8),
    { "saturation", "per_channel", "", { 0.4, 0.6, 0.8, 1.0, 1.2, 0.1 } });
  const double level[] = { 0.4, 0.6, 0.8, 1.0, 1.2 };
  for (int k = 0; k < 5; ++k)
  {
    EXPECT_NEAR(u(k, 0), std::pow(std::pow(0.8, -10.0) + std::pow(level[k], -10.0), -0.1), 1e-15);
  }
}

// With two it is a hypotenuse; at the level itself any sharpness p leaves 2^(-1/p).
TEST(Saturation, GraduallyItIsAPNorm)
{
  const double u = 0.5 / 0.8;
  EXPECT_NEAR(respondToFlat(0.5, { "saturation", "gradual", "", { 0.8, 2.0 } }),
    0.5 / std::hypot(1.0, u), 1e-15);
  EXPECT_NEAR(respondToFlat(0.8, { "saturation", "gradual", "", { 0.8, 10.0 } }),
    0.8 * std::pow(2.0, -0.1), 1e-15);
  EXPECT_EQ(respondToFlat(-0.01, { "saturation", "gradual", "", { 0.8, 10.0 } }), -0.01);
}

// (u / level)^p is more than single precision holds.
TEST(Saturation, FarBeyondItsLevelAnImageIsNotDark)
{
  const msi::CameraModel identity(
    fiveBands(), Eigen::MatrixXd::Identity(5, 5), Eigen::VectorXd::Zero(5));
  const msi::ImageSimulator simulator(
    identity, { { "saturation", "gradual", "", { 0.1, 60.0 } } }, { 1, 1 });
  const std::vector<float> reflectance(5, 0.9F);
  std::vector<float> response(5);
  msi::ImageWorkspace work;
  simulator.simulate(
    reflectance.data(), nullptr, { 0, 0, 1, 1 }, { 0, 0, 1, 1 }, nullptr, response.data(), work);
  EXPECT_NEAR(response[2], 0.1, 1e-7);
}

TEST(SessionDrift, FollowsItsCourse)
{
  const Eigen::MatrixXd even = Eigen::MatrixXd::Constant(5, 5, 0.5);
  const auto over = [&even](const char* form, std::vector<double> parameters)
  {
    return Eigen::RowVectorXd(
      respondTo(even, { "session_drift", form, "", std::move(parameters) }).row(2));
  };
  const Eigen::RowVectorXd slope = over("slope", { 0.1, 0.25 });
  const Eigen::RowVectorXd step = over("step", { -0.06, 0.6, 0.02 });
  const Eigen::RowVectorXd warm = over("warm_up", { 0.1, 0.5 });
  const Eigen::RowVectorXd settling = over("settling", { 0.1, 0.5 });
  const Eigen::RowVectorXd offset = over("offset_slope", { 0.02, 0.0 });
  for (int i = 0; i < 5; ++i)
  {
    const double t = 0.25 * i;
    EXPECT_NEAR(slope[i], 0.5 * (1.0 + 0.1 * (t - 0.25)), 1e-15);
    EXPECT_NEAR(step[i], t < 0.6 ? 0.5 : 0.47, 1e-15);
    EXPECT_NEAR(warm[i], 0.5 * (1.0 + 0.1 * (1.0 - std::exp(-t / 0.5))), 1e-15);
    EXPECT_NEAR(settling[i], 0.5 * (1.0 + 0.1 * std::exp(-t / 0.5)), 1e-15);
    EXPECT_NEAR(offset[i], 0.5 + 0.02 * t, 1e-15);
  }
  const Eigen::MatrixXd each =
    respondTo(even, { "session_drift", "slope_per_channel", "", { 0.0, 0.1, 0.2, 0.3, 0.4, 0.0 } });
  EXPECT_NEAR(each(4, 4), 0.5 * 1.4, 1e-15);
  EXPECT_EQ(each(0, 4), 0.5);
  const Eigen::MatrixXd warming = respondTo(
    even, { "session_drift", "warm_up_per_channel", "", { 0.0, 0.1, 0.2, 0.3, 0.4, 0.5 } });
  const Eigen::MatrixXd resting = respondTo(
    even, { "session_drift", "settling_per_channel", "", { 0.0, 0.1, 0.2, 0.3, 0.4, 0.5 } });
  for (int k = 0; k < 5; ++k)
  {
    EXPECT_NEAR(warming(k, 4), 0.5 * (1.0 + 0.1 * k * (1.0 - std::exp(-2.0))), 1e-15);
    EXPECT_NEAR(resting(k, 4), 0.5 * (1.0 + 0.1 * k * std::exp(-2.0)), 1e-15);
  }
}

}

#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using msi::CameraEffect;
using msi::CameraSimulator;
using msi::test::rasterSamples;
using msi::test::sevenChannels;
using msi::test::visibleGrid;

// The raster with these flat reflectances, and the camera without its dark response.
Eigen::MatrixXd respondToFlat(const Eigen::RowVectorXd& reflectance, const CameraEffect& effect)
{
  msi::SceneSamples samples = rasterSamples(reflectance.size());
  samples.reflectance = Eigen::VectorXd::Ones(31) * reflectance;
  const msi::CameraModel camera =
    sevenChannels().with(sevenChannels().responsivity(), Eigen::VectorXd::Zero(7));
  return CameraSimulator(camera, { effect }).respond({ visibleGrid(), samples });
}

const Eigen::RowVectorXd White = Eigen::RowVectorXd::Ones(48);

TEST(IlluminationGradient, IsAPlaneOverTheField)
{
  const Eigen::MatrixXd u =
    respondToFlat(White, { "illumination_gradient", "", "", { 0.10, -0.04 } });
  EXPECT_NEAR(u(3, 0), 1.0 - 0.10 + 0.04 * 25.0 / 35.0, 1e-14);
  EXPECT_NEAR(u(3, 7), 1.0 + 0.10 + 0.04 * 25.0 / 35.0, 1e-14);
  EXPECT_NEAR(u(0, 47), 1.0 + 0.10 - 0.04 * 25.0 / 35.0, 1e-14);
}

// 1 / (1 - s / 2)^2 = 1 + s + 3/4 s^2 + 1/2 s^3 + ..
TEST(IlluminationGradient, BentItIsTheInverseSquareOfADistance)
{
  const double right = 0.08;
  const Eigen::MatrixXd u = respondToFlat(
    White, { "illumination_gradient", "bent", "", { right, 0.0, 0.75 * right * right, 0.0 } });
  for (const double side : { -1.0, 1.0 })
  {
    const double s = side * right;
    EXPECT_NEAR(
      u(3, side < 0.0 ? 0 : 7), 1.0 / std::pow(1.0 - 0.5 * s, 2), 0.6 * right * right * right);
  }
}

// 0.1 P_2(x) P_1(y) - 0.2 P_6(y), of the standard library.
TEST(IlluminationGradient, MayHaveAnyShape)
{
  CameraEffect light =
    msi::neutralEffect("illumination_gradient", sevenChannels().channels(), "any_shape");
  const std::vector<msi::EffectParameter> names =
    msi::effectParameters(light, sevenChannels().channels());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    light.parameters[i] = names[i].name == "order_2_1" ? 0.1
      : names[i].name == "order_0_6"                   ? -0.2
                                                       : 0.0;
  }
  const Eigen::MatrixXd u = respondToFlat(White, light);
  // The sixth of eight columns, the first of six rows.
  const double x = 1.0 - 2.0 / 7.0 * 2.0;
  const double y = -25.0 / 35.0;
  EXPECT_NEAR(u(3, 5),
    1.0 + 0.1 * std::legendre(2, x) * std::legendre(1, y) - 0.2 * std::legendre(6, y), 1e-14);
}

// Seven channels.
TEST(IlluminationGradient, MayDifferBetweenTheChannels)
{
  const Eigen::MatrixXd u = respondToFlat(White,
    { "illumination_gradient", "per_channel", "",
      { 0.0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.04 } });
  EXPECT_NEAR(u(0, 7), 1.0, 1e-14);
  EXPECT_NEAR(u(3, 0), 1.0 - 0.03, 1e-14);
  EXPECT_NEAR(u(6, 7), 1.0 + 0.06 + 0.04 * 25.0 / 35.0, 1e-14);
}

TEST(DarkOffset, MayBeAPlaneOverTheField)
{
  const std::vector<double> offset(7, 0.02);
  const std::vector<double> alongX{ 0.0, 0.001, 0.002, 0.003, 0.004, 0.005, 0.006 };
  const std::vector<double> alongY(7, -0.007);
  CameraEffect plane{ "dark_offset", "plane", "", offset };
  plane.parameters.insert(plane.parameters.end(), alongX.begin(), alongX.end());
  plane.parameters.insert(plane.parameters.end(), alongY.begin(), alongY.end());
  const Eigen::MatrixXd u = respondToFlat(White, plane);
  EXPECT_NEAR(u(0, 0), 1.0 + 0.02 + 0.007 * 25.0 / 35.0, 1e-14);
  EXPECT_NEAR(u(6, 7), 1.0 + 0.02 + 0.006 + 0.007 * 25.0 / 35.0, 1e-14);
  // As every effect of the field it needs positions.
  msi::SceneSamples nowhere;
  nowhere.reflectance = Eigen::MatrixXd::Ones(31, 2);
  EXPECT_THROW(CameraSimulator(sevenChannels(), { plane }).respond({ visibleGrid(), nowhere }),
    std::invalid_argument);
}

TEST(Vignetting, MayDifferBetweenTheChannels)
{
  const Eigen::MatrixXd u = respondToFlat(White,
    { "vignetting", "per_channel", "", { 0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12, -1.0, 0.0 } });
  const double square = 4.0 + 625.0 / 1225.0;
  for (int k = 0; k < 7; ++k)
  {
    EXPECT_NEAR(u(k, 7), 1.0 - 0.02 * k * square, 1e-14);
  }
}

TEST(Vignetting, IsTheFourthPowerOfTheCosine)
{
  const Eigen::MatrixXd u = respondToFlat(White, { "vignetting", "cos4", "", { 0.4, 0.0, 0.0 } });
  const double radius = std::hypot(1.0, 25.0 / 35.0);
  EXPECT_NEAR(u(2, 0), std::pow(std::cos(std::atan(0.4 * radius)), 4), 1e-14);
}

TEST(Vignetting, QuadraticFalloffIsAboutItsCenter)
{
  const Eigen::MatrixXd u =
    respondToFlat(White, { "vignetting", "", "", { 0.2, -1.0, -25.0 / 35.0 } });
  EXPECT_NEAR(u(2, 0), 1.0, 1e-14);
  EXPECT_NEAR(u(2, 7), 1.0 - 0.2 * 4.0, 1e-14);
}

TEST(Vignetting, PolynomialHasTheFourthAndTheSixthPowerAndIsNeverNegative)
{
  const Eigen::MatrixXd u =
    respondToFlat(White, { "vignetting", "polynomial", "", { 0.1, 0.05, -0.02, 0.5, 0.0 } });
  const double square = 0.25 + 625.0 / 1225.0;
  EXPECT_NEAR(
    u(2, 7), 1.0 - 0.1 * square - 0.05 * square * square + 0.02 * square * square * square, 1e-14);
  const Eigen::MatrixXd dark =
    respondToFlat(White, { "vignetting", "polynomial", "", { 0.45, 0.6, 0.6, 0.0, 0.0 } });
  EXPECT_EQ(dark(2, 7), 0.0);
}

TEST(VeilingGlare, ShowsTheSceneMeanInABlackSample)
{
  // Scene a is the left half: one sample of 0.6 among 24.
  Eigen::RowVectorXd reflectance = Eigen::RowVectorXd::Zero(48);
  reflectance[1] = 0.6;
  const Eigen::MatrixXd u = respondToFlat(reflectance, { "veiling_glare", "", "", { 0.05 } });
  EXPECT_NEAR(u(4, 0), 0.05 * 0.6 / 24.0, 1e-15);
  EXPECT_NEAR(u(4, 1), 0.6 + 0.05 * 0.6 / 24.0, 1e-15);
  EXPECT_EQ(u(4, 5), 0.0);
}

TEST(VeilingGlare, ConservingKeepsTheSceneMean)
{
  const Eigen::RowVectorXd reflectance = Eigen::RowVectorXd::LinSpaced(48, 0.0, 1.0);
  const Eigen::MatrixXd before = respondToFlat(reflectance, { "veiling_glare", "", "", { 0.0 } });
  const Eigen::MatrixXd after =
    respondToFlat(reflectance, { "veiling_glare", "conserving", "", { 0.1 } });
  EXPECT_NEAR(after.mean(), before.mean(), 1e-14);
  EXPECT_GT((after - before).norm(), 0.1);
}

TEST(LocalStrayLight, LeavesAnEvenFieldAlone)
{
  const Eigen::MatrixXd u =
    respondToFlat(0.5 * White, { "local_stray_light", "", "", { 0.2, 8.0 } });
  EXPECT_LT((u.array() - 0.5).abs().maxCoeff(), 1e-14);
}

TEST(LocalStrayLight, BrightensTheNeighboursOfABrightSample)
{
  Eigen::RowVectorXd reflectance = Eigen::RowVectorXd::Zero(48);
  reflectance[9] = 0.8; // second row, second column: eight neighbours
  const Eigen::MatrixXd u =
    respondToFlat(reflectance, { "local_stray_light", "", "", { 0.1, 8.0 } });
  EXPECT_NEAR(u(0, 9), 0.8 * 0.9, 1e-14);
  EXPECT_NEAR(u(0, 10), 0.1 * 0.8 / 8.0, 1e-14);
  EXPECT_NEAR(u(0, 0), 0.1 * 0.8 / 3.0, 1e-14); // a corner has three neighbours
  EXPECT_EQ(u(0, 12), 0.0);                     // another scene
}

TEST(LocalStrayLight, FallsOffExponentiallyOverTheSceneInPitches)
{
  // One bright sample of scene a, whose raster is 4 columns by 6 rows.
  Eigen::RowVectorXd reflectance = Eigen::RowVectorXd::Zero(48);
  reflectance[9] = 0.8;
  const double reach = 0.7;
  const Eigen::MatrixXd u =
    respondToFlat(reflectance, { "local_stray_light", "tail", "", { 0.1, reach, 8.0 } });
  for (const int sample : { 10, 11, 0, 26, 43 })
  {
    const auto weight = [&](int other)
    { return std::exp(-std::hypot(sample % 8 - other % 8, sample / 8 - other / 8) / reach); };
    double sum = 0.0;
    for (int other = 0; other < 48; ++other)
    {
      sum += other % 8 < 4 && other != sample ? weight(other) : 0.0;
    }
    EXPECT_NEAR(u(0, sample), 0.1 * 0.8 * weight(9) / sum, 1e-8) << sample;
  }
  EXPECT_EQ(u(0, 12), 0.0); // another scene
}

}

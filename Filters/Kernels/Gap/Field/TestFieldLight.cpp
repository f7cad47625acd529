#include "Kernels/Gap/Field/TestFieldReport.h"
#include "Kernels/Numerics/Angle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using msi::GapReport;
using msi::GapVerdict;
using namespace msi::test;
}

TEST(FieldGap, VignettingIsRadial)
{
  const TestScene scene(1);
  const TestPair pair = changed(scene, 11,
    [&](double u, int, int x, int y, double)
    { return u * (1.0 - 0.08 * (std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2))); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "vignetting", "position");
  expectParameter(report, "vignetting", "falloff", 0.08, 0.002);
}

// Planck's law at 430 to 670 nm, 2856 K and 4000 K. The curve over eight channels is no coincidence of eight gains.
TEST(FieldGap, LampOfAnotherTemperature)
{
  const TestScene scene(61, 8, 120, 100);
  const auto planck = [](int k, double kelvin)
  { return 1.0 / std::expm1(14388.0 / ((0.43 + 0.24 / 7.0 * k) * kelvin)); };
  const auto change = [&](int k)
  { return planck(k, 4000.0) / planck(k, 2856.0) * planck(4, 2856.0) / planck(4, 4000.0); };
  const GapReport report =
    diagnose(changed(scene, 71, [&](double u, int k, int, int, double) { return u * change(k); }));
  expectFirst(report, "illuminant_drift", "channel");
  EXPECT_LT(report.probabilityOf("unknown"), 0.1);
  // The even polynomials are the same at both ends.
  const double twist = findParameter(report, "illuminant_drift", "twist") == nullptr
    ? 0.0
    : findParameter(report, "illuminant_drift", "twist")->value;
  EXPECT_NEAR(findParameter(report, "illuminant_drift", "tilt")->value + twist,
    0.5 * std::log(change(7) / change(0)), 0.02);
}

TEST(FieldGap, GradientIsAPlane)
{
  const TestScene scene(2);
  const TestPair pair = changed(scene, 12,
    [&](double u, int, int x, int y, double)
    { return u * (1.0 + 0.05 * scene.fieldX(x) - 0.03 * scene.fieldY(y)); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "illumination_gradient", "position");
  expectParameter(report, "illumination_gradient", "along_x", 0.05, 0.002);
  expectParameter(report, "illumination_gradient", "along_y", -0.03, 0.002);
}

// One of the two lamps is bluer than the other: the numbers follow a line over the channels, which makes them no less likely.
TEST(FieldGap, LampsOfDifferentColoursOnTheTwoSides)
{
  const TestScene scene(62, 8, 120, 100);
  const GapReport report = diagnose(changed(scene, 72,
    [&](double u, int k, int x, int, double) { return u * (1.0 + 0.01 * k * scene.fieldX(x)); }));
  expectFirst(report, "illumination_gradient", "position");
  EXPECT_LT(report.probabilityOf("unknown"), 0.1);
  expectParameter(report, "illumination_gradient", "along_x[C8]", 0.07, 0.004);
  expectParameter(report, "illumination_gradient", "along_y[C8]", 0.0, 0.004);
}

// They leave the square of the place along the line between them, and no slope.
TEST(FieldGap, TwoLampsThatAreAlike)
{
  const TestScene scene(63, 8, 120, 100);
  const GapReport report = diagnose(changed(scene, 73,
    [&](double u, int, int x, int y, double)
    {
      const double along = (scene.fieldX(x) + scene.fieldY(y)) / std::sqrt(2.0);
      return u * (1.0 + 0.08 * along * along);
    }));
  expectFirst(report, "illumination_gradient", "position");
  EXPECT_EQ(report.causes.front().form, "bent");
  expectParameter(report, "illumination_gradient", "square", 0.08, 0.004);
  expectParameter(report, "illumination_gradient", "turn", 45.0, 4.0);
}

// Coatings and filters pass less of some colours off the axis.
TEST(FieldGap, VignettingOfEachChannel)
{
  const TestScene scene(64);
  const double falloff[] = { 0.05, 0.16, 0.09 };
  const GapReport report = diagnose(changed(scene, 74,
    [&](double u, int k, int x, int y, double)
    {
      return u * (1.0 - falloff[k] * (std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2)));
    }));
  expectFirst(report, "vignetting", "position");
  expectParameter(report, "vignetting", "falloff[C2]", 0.16, 0.004);
}

// A window beside the camera: more of its light on one side, whatever the scene sends.
TEST(FieldGap, LightFromOneSideIsAnOffset)
{
  const TestScene scene(65);
  const GapReport report = diagnose(changed(scene, 75,
    [&](double u, int k, int x, int, double)
    { return u + (0.01 + 0.004 * k) * (1.0 + scene.fieldX(x)); }));
  expectFirst(report, "dark_offset", "position");
  EXPECT_EQ(report.causes.front().form, "plane");
  expectParameter(report, "dark_offset", "along_x[C3]", 0.018, 0.001);
}

// A lamp that is near: the inverse square of the distance is 1 + s + 3/4 s^2 but for higher orders.
TEST(FieldGap, GradientThatBends)
{
  const TestScene scene(45);
  const TestPair pair = changed(scene, 55,
    [&](double u, int, int x, int y, double)
    {
      const double s = 0.2 * scene.fieldX(x) - 0.1 * scene.fieldY(y);
      return u * (1.0 + s + 0.75 * s * s);
    });
  const GapReport report = diagnose(pair);
  expectFirst(report, "illumination_gradient", "position");
  EXPECT_EQ(report.causes.front().form, "bent");
  expectParameter(report, "illumination_gradient", "along_x", 0.2, 0.002);
  expectParameter(report, "illumination_gradient", "along_y", -0.1, 0.002);
  expectParameter(report, "illumination_gradient", "square", 0.75 * (0.04 + 0.01), 0.004);
  expectParameter(
    report, "illumination_gradient", "turn", std::atan2(-0.1, 0.2) / msi::Degree, 4.0);
}

// Two lamps near the corners, and a card that keeps light from one side: no plane, no lens.
TEST(FieldGap, LightOfNoSimpleShape)
{
  const auto light = [](double x, double y)
  {
    const auto spot = [=](double atX, double atY)
    { return std::exp(-2.0 * (std::pow(x - atX, 2) + std::pow(y - atY, 2))); };
    return 0.9 + 0.2 * spot(-0.9, -0.5) + 0.15 * spot(0.7, 0.6) -
      0.1 / (1.0 + std::exp(-6.0 * (x - 0.6)));
  };
  double mean = 0.0; // over a square field
  for (int i = 0; i < 1600; ++i)
  {
    mean += light((i % 40 + 0.5) / 20.0 - 1.0, (i / 40 + 0.5) / 20.0 - 1.0) / 1600.0;
  }
  const TestScene scene(66);
  const GapReport report = diagnose(changed(scene, 76,
    [&](double u, int, int x, int y, double)
    { return u * light(scene.fieldX(x), scene.fieldY(y)) / mean; }));
  expectFirst(report, "illumination_gradient", "position");
  EXPECT_EQ(report.causes.front().form, "any_shape");
  EXPECT_LT(report.probabilityOf("unknown"), 0.1);
}

// Seen against a white in the same light, the middle is too bright and the border too dark.
TEST(FieldGap, FalloffAboutItsMean)
{
  const TestScene scene(36);
  const TestPair pair = changed(scene, 47,
    [&](double u, int, int x, int y, double)
    {
      const double rho2 = std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2);
      return u * 1.06 * (1.0 - 0.1 * rho2);
    });
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  ASSERT_EQ(report.causes.size(), 2U);
  expectParameter(report, "vignetting", "falloff", 0.1, 0.003);
  expectParameter(report, "exposure_gain", "gain", 1.06, 0.003);
}

// More than two million pixels: nine windows of it are looked at.
TEST(FieldGap, LargeImages)
{
  TestPair pair;
  pair.extent = { 2400, 1000 };
  pair.channels = { "C1" };
  const msi::CounterRandom random(5);
  for (int y = 0; y < pair.extent.height; ++y)
  {
    for (int x = 0; x < pair.extent.width; ++x)
    {
      const double u = 0.4 + 0.15 * std::sin(0.11 * x + 0.07 * y) * std::cos(0.013 * x - 0.09 * y);
      const double X = (x - 1199.5) / 1199.5;
      const double Y = (y - 499.5) / 1199.5;
      const auto pixel = static_cast<std::uint64_t>(pair.simulated.size());
      pair.simulated.push_back(static_cast<float>(u));
      pair.real.push_back(static_cast<float>(
        u * (1.0 + 0.03 * Y) * (1.0 - 0.06 * (X * X + Y * Y)) + 0.004 * random.normal(pixel)));
    }
  }
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  // About a center off the middle, 0.25 from it, it is the same to second order; the third is .03 x .06.
  EXPECT_LE(report.causes.size(), 2U);
  expectParameter(report, "vignetting", "falloff", 0.06, 0.005);
}

TEST(FieldGap, VignettingOffTheMiddle)
{
  const TestScene scene(40);
  const TestPair pair = changed(scene, 50,
    [&](double u, int, int x, int y, double)
    {
      return u *
        (1.0 - 0.12 * (std::pow(scene.fieldX(x) - 0.25, 2) + std::pow(scene.fieldY(y) + 0.15, 2)));
    });
  const GapReport report = diagnose(pair);
  expectFirst(report, "vignetting", "position");
  expectParameter(report, "vignetting", "falloff", 0.12, 0.003);
  expectParameter(report, "vignetting", "center_x", 0.25, 0.02);
  expectParameter(report, "vignetting", "center_y", -0.15, 0.02);
}

// cos^4 of the field angle with tangent 0.7 at rho = 1: no polynomial of sixth order, but near one.
TEST(FieldGap, SteepFalloff)
{
  const TestScene scene(41);
  const auto light = [](double rho2) { return std::pow(1.0 + 0.49 * rho2, -2.0); };
  const TestPair pair = changed(scene, 51,
    [&](double u, int, int x, int y, double)
    { return u * light(std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2)); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "vignetting", "position", 0.95);
  EXPECT_EQ(report.causes.front().form, "polynomial");
  const auto value = [&report](const char* name)
  { return findParameter(report, "vignetting", name)->value; };
  ASSERT_NE(findParameter(report, "vignetting", "sixth"), nullptr);
  for (const double rho2 : { 0.2, 0.5, 0.9 })
  {
    EXPECT_NEAR(1.0 - rho2 * (value("falloff") + rho2 * (value("fourth") + rho2 * value("sixth"))),
      light(rho2), 0.005);
  }
}

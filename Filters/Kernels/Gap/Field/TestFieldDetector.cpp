#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{
using msi::FieldGap;
using msi::GapReport;
using msi::GapVerdict;
using namespace msi::test;
}

TEST(FieldGap, GlareGoesWithTheMeanOfTheScene)
{
  const TestScene scene(3);
  const double level[] = { 1.0, 0.4, 1.6 };
  // Channels of different brightness: only then does glare differ from a common offset.
  TestPair pair = changed(scene, 13, [](double u, int, int, int, double) { return u; });
  for (std::size_t k = 0; k < 3; ++k)
  {
    double mean = 0.0;
    const std::size_t pixels = pair.simulated.size() / 3;
    for (std::size_t i = 0; i < pixels; ++i)
    {
      pair.simulated[i * 3 + k] *= static_cast<float>(level[k]);
      mean += static_cast<double>(pair.simulated[i * 3 + k]) / static_cast<double>(pixels);
    }
    for (std::size_t i = 0; i < pixels; ++i)
    {
      pair.real[i * 3 + k] =
        static_cast<float>(level[k]) * pair.real[i * 3 + k] + static_cast<float>(0.04 * mean);
    }
  }
  const GapReport report = diagnose(pair);
  expectFirst(report, "veiling_glare", "channel");
  expectParameter(report, "veiling_glare", "fraction", 0.04, 0.001);
}

// A curve that leaves black and white as they are is one effect, not a curve and an exposure.
TEST(FieldGap, CurveThatKeepsWhite)
{
  const TestScene scene(46);
  const TestPair pair = changed(scene, 56,
    [](double u, int, int, int, double) { return std::log1p(0.4 * u) / std::log1p(0.4); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "detector_nonlinearity", "level");
}

// One curve in counts, seen by channels that are exposed to a third and more of its range.
TEST(FieldGap, CurveOfChannelsThatAreExposedDifferently)
{
  const TestScene scene(66, 8, 120, 100);
  const auto square = [](int k)
  {
    const double exposure = 0.3 + 0.1 * k;
    return 0.12 * exposure / (1.0 + 0.12 * exposure); // relative to white
  };
  const GapReport report = diagnose(changed(
    scene, 76, [&](double u, int k, int, int, double) { return u + square(k) * (u * u - u); }));
  expectFirst(report, "detector_nonlinearity", "channel");
  EXPECT_LT(report.probabilityOf("unknown"), 0.1);
  expectParameter(report, "detector_nonlinearity", "square[C1]", square(0), 0.005);
  expectParameter(report, "detector_nonlinearity", "square[C8]", square(7), 0.005);
}

TEST(FieldGap, WhatAllChannelsHaveInCommonIsCrosstalk)
{
  const TestScene scene(67, 4, 120, 100);
  TestPair pair = changed(scene, 77, [](double u, int, int, int, double) { return u; });
  for (std::size_t i = 0; i < pair.real.size(); i += 4)
  {
    const float mean = 0.25F *
      (pair.simulated[i] + pair.simulated[i + 1] + pair.simulated[i + 2] + pair.simulated[i + 3]);
    for (std::size_t k = 0; k < 4; ++k)
    {
      pair.real[i + k] += 0.05F * (mean - pair.simulated[i + k]);
    }
  }
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "channel_crosstalk");
  EXPECT_EQ(report.causes.front().form, "shared");
  expectParameter(report, "channel_crosstalk", "coupling", 0.05, 0.003);
}

// A curve with a toe and a shoulder: no plain one comes near.
TEST(FieldGap, CurveWithATurn)
{
  const TestScene scene(47);
  const TestPair pair = changed(
    scene, 57, [](double u, int, int, int, double) { return u + 0.3 * u * u - 0.3 * u * u * u; });
  const GapReport report = diagnose(pair);
  expectFirst(report, "detector_nonlinearity", "level");
  expectParameter(report, "detector_nonlinearity", "square", 0.3, 0.01);
  expectParameter(report, "detector_nonlinearity", "cube", -0.3, 0.01);
}

TEST(FieldGap, OffsetsOfChannelsMayBeGlare)
{
  const TestScene scene(4);
  const double offset[] = { 0.004, 0.012, 0.006 };
  const TestPair pair =
    changed(scene, 14, [&](double u, int k, int, int, double) { return u + offset[k]; });
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_EQ(report.where.front().axis, "channel");
  ASSERT_EQ(report.causes.size(), 1U);
  expectParameter(report, "dark_offset", "offset[C2]", 0.012, 0.0005);
  EXPECT_EQ(report.causes.front().equivalent, std::vector<std::string>{ "veiling_glare" });
  // Each of the two would tell; nothing else is in question.
  ASSERT_EQ(report.nextCaptures.size(), 2U);
  EXPECT_EQ(report.nextCaptures[0].capture, "lens cap");
  EXPECT_EQ(report.nextCaptures[1].capture, "black trap, second scene");
  EXPECT_LE(report.nextCaptures[0].expectedBits.value(), 1.0);
}

// Light that is scattered adds; a dark signal that was taken off twice is missing.
TEST(FieldGap, NegativeOffsetsAreNoGlare)
{
  const TestScene scene(42);
  const double offset[] = { 0.004, 0.012, -0.006 };
  const TestPair pair =
    changed(scene, 52, [&](double u, int k, int, int, double) { return u + offset[k]; });
  const GapReport report = diagnose(pair);
  expectFirst(report, "dark_offset", "channel");
  expectParameter(report, "dark_offset", "offset[C3]", -0.006, 0.0005);
  EXPECT_TRUE(report.causes.front().equivalent.empty());
}

TEST(FieldGap, GainOfAChannel)
{
  const TestScene scene(5);
  const double gain[] = { 1.0, 0.96, 1.03 };
  const TestPair pair =
    changed(scene, 15, [&](double u, int k, int, int, double) { return u * gain[k]; });
  const GapReport report = diagnose(pair);
  expectFirst(report, "channel_gain", "channel");
  expectParameter(report, "channel_gain", "gain[C2]", 0.96, 0.001);
}

TEST(FieldGap, ExposureIsOneNumber)
{
  const TestScene scene(6);
  const TestPair pair =
    changed(scene, 16, [&](double u, int, int, int, double) { return u * 0.95; });
  const GapReport report = diagnose(pair);
  expectFirst(report, "exposure_gain", "level");
  expectParameter(report, "exposure_gain", "gain", 0.95, 0.001);
}

// Added to the channel, or taken from one and given to the next: then it is crosstalk of one side, too.
TEST(FieldGap, LagOfTheChannelBefore)
{
  const TestScene scene(31, 4);
  std::vector<ImagePlane> planes;
  for (int k = 0; k < scene.channels(); ++k)
  {
    planes.push_back(scene.pixels(scene.fine(k)));
  }
  for (const bool conserving : { false, true })
  {
    const TestPair pair = changed(scene, 41,
      [&](double u, int k, int x, int y, double)
      {
        const double before = k > 0 ? planes[static_cast<std::size_t>(k) - 1].read(x, y) : 0.0;
        return u + 0.05 * (before - (conserving && k > 0 ? u : 0.0));
      });
    const GapReport report = diagnose(pair);
    SCOPED_TRACE(describe(report));
    ASSERT_EQ(report.causes.size(), 1U);
    EXPECT_EQ(report.causes.front().effect, "lag");
    EXPECT_EQ(report.causes.front().form, conserving ? "conserving" : "common");
    EXPECT_EQ(report.causes.front().equivalent,
      conserving ? std::vector<std::string>{ "channel_crosstalk" } : std::vector<std::string>{});
    EXPECT_EQ(report.verdict, GapVerdict::Explained);
    expectParameter(report, "lag", "retained", 0.05, 0.001);
  }
}

// Few pixels are that bright; all others are as they were.
TEST(FieldGap, SaturationOfTheBrightest)
{
  const TestScene scene(32);
  const TestPair pair =
    changed(scene, 42, [](double u, int, int, int, double) { return std::fmin(u, 0.45); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "saturation", "level");
  EXPECT_GT(report.where.front().share, 0.9);
  expectParameter(report, "saturation", "level[C2]", 0.45, 0.005);
}

TEST(FieldGap, SaturationAtALevelOfEachChannel)
{
  const TestScene scene(68);
  const double level[] = { 0.5, 2.0, 0.42 };
  const GapReport report = diagnose(
    changed(scene, 78, [&](double u, int k, int, int, double) { return std::fmin(u, level[k]); }));
  expectFirst(report, "saturation", "level");
  EXPECT_LT(report.probabilityOf("unknown"), 0.1);
  expectParameter(report, "saturation", "level[C1]", 0.5, 0.005);
  expectParameter(report, "saturation", "level[C3]", 0.42, 0.005);
}

// A full well fills up gradually: a p-norm of light and level, here with p = 8, and no curve beside it.
TEST(FieldGap, SaturationOfAFullWellIsSoft)
{
  const TestScene scene(36);
  const GapReport report = diagnose(changed(scene, 46,
    [](double u, int, int, int, double)
    { return u / std::pow(1.0 + std::pow(u / 0.5, 8.0), 1.0 / 8.0); }));
  expectFirst(report, "saturation", "level");
  expectParameter(report, "saturation", "level[C2]", 0.5, 0.005);
  expectParameter(report, "saturation", "softness", 1.0 / 8.0, 0.005);
}

// Darks of the channels that are nearly the same are one cause beside a curve, not what its form leaves.
TEST(FieldGap, DarkOffsetsThatAreAlikeBesideACurve)
{
  const TestScene scene(34);
  const double dark[] = { -0.027, -0.028, -0.037 };
  const GapReport report = diagnose(changed(scene, 44,
    [&](double u, int k, int, int, double) { return u * (1.0 + 0.075 * u) / 1.075 + dark[k]; }));
  SCOPED_TRACE(describe(report));
  ASSERT_EQ(report.causes.size(), 2U);
  EXPECT_EQ(report.causes[0].effect, "dark_offset");
  EXPECT_EQ(report.causes[1].effect, "detector_nonlinearity");
  EXPECT_GT(report.causes[0].probability, 0.9);
  expectParameter(report, "dark_offset", "offset[C3]", -0.037, 0.002);
}

TEST(FieldGap, NonlinearityIsAPowerOrACompression)
{
  const TestScene scene(33);
  const GapReport power =
    diagnose(changed(scene, 43, [](double u, int, int, int, double) { return std::pow(u, 1.1); }));
  expectFirst(power, "detector_nonlinearity", "level");
  EXPECT_EQ(power.causes.front().form, "gamma");
  expectParameter(power, "detector_nonlinearity", "exponent", 1.1, 0.005);
  const GapReport bent = diagnose(
    changed(scene, 44, [](double u, int, int, int, double) { return u / (1.0 + 0.3 * u); }));
  expectFirst(bent, "detector_nonlinearity", "level");
}

// Nearly another curve with another gain, which effect by effect comes first.
TEST(FieldGap, AnOffsetAndACurve)
{
  const TestScene scene(43);
  const GapReport report = diagnose(
    changed(scene, 53, [](double u, int, int, int, double) { return 0.06 + u - 0.18 * u * u; }));
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_EQ(report.causes.size(), 2U);
  expectParameter(report, "dark_offset", "offset", 0.06, 0.001);
  expectParameter(report, "detector_nonlinearity", "square", -0.18, 0.005);
}

// A gain in place of each channel's curve leaves what a gain cannot leave.
TEST(FieldGap, ACurveThatMayNotBeNamedIsNotBlamedOnGainsAndOffsets)
{
  const TestScene scene(44);
  msi::GapOptions options;
  options.without = { "detector_nonlinearity" };
  const TestPair pair =
    changed(scene, 54, [](double u, int, int, int, double) { return std::pow(u, 1.2); });
  const GapReport report = msi::diagnoseField(pair.pair(), options)->report;
  SCOPED_TRACE(describe(report));
  EXPECT_NE(report.verdict, GapVerdict::Explained);
  EXPECT_NE(report.verdict, GapVerdict::NoGap);
  EXPECT_GT(report.unexplained.share, 0.15);
  EXPECT_GT(report.probabilityOf("unknown"), 0.2);
}

// Counts of a camera whose white is 3200 of 65535, with an offset of 96, under uneven light.
TEST(FieldGap, CountsOfARawImage)
{
  const TestScene scene(35, 3);
  TestPair pair = makePair(
    scene,
    [&](int k)
    {
      ImagePlane plane = scene.pixels(scene.fine(k));
      for (int y = 0; y < plane.height; ++y)
      {
        for (int x = 0; x < plane.width; ++x)
        {
          const double rho2 = std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2);
          const double light = (1.0 - 0.07 * scene.fieldX(x)) * (1.0 - 0.06 * rho2);
          plane.at(x, y) = 0.03 + plane.at(x, y) * light;
        }
      }
      return plane;
    },
    46, 0.001, 0.001);
  for (float& value : pair.real)
  {
    value *= 3200.0F;
  }
  const FieldGap found = *msi::diagnoseField(pair.pair());
  const GapReport& report = found.report;
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  // The unit may hold a part of the gain; what the camera does is the product.
  const msi::GapParameter* gain = findParameter(report, "exposure_gain", "gain");
  const double left = gain == nullptr ? 1.0 : gain->value;
  EXPECT_NEAR(found.unit[0] * left, 3200.0, 0.01 * 3200.0);
  const msi::GapParameter* offset = findParameter(report, "dark_offset", "offset");
  ASSERT_NE(offset, nullptr);
  EXPECT_NEAR(offset->value * found.unit[0], 96.0, 3.0);
  expectParameter(report, "vignetting", "falloff", 0.06, 0.003);
  expectParameter(report, "illumination_gradient", "along_x", -0.07, 0.002);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes.front().find("not in units of white"), std::string::npos);
}

// What goes wrong with captured image pairs every day.
#include "Kernels/Gap/Field/TestFieldReport.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace
{
using msi::GapReport;
using msi::GapVerdict;
using namespace msi::test;

bool says(const GapReport& report, const std::string& words)
{
  return std::any_of(report.notes.begin(), report.notes.end(),
    [&words](const std::string& note) { return note.find(words) != std::string::npos; });
}

double exponent(double u)
{
  return std::pow(u, 0.93);
}

bool isInSpot(int x, int y)
{
  return std::hypot(x - 40.0, y - 60.0) < 7.0;
}

// Where inside(x, y), in all channels of the real image.
template <typename Inside>
void paint(TestPair& pair, const TestScene& scene, const Inside& inside, float value)
{
  const std::size_t channels = pair.channels.size();
  for (int y = 0; y < scene.height(); ++y)
  {
    for (int x = 0; x < scene.width(); ++x)
    {
      if (inside(x, y))
      {
        std::fill_n(
          pair.real.begin() + static_cast<std::ptrdiff_t>(pair.pair().index(x, y) * channels),
          channels, value);
      }
    }
  }
}
}

TEST(FieldMistakes, ASpotIsNamedAndLeftOut)
{
  const TestScene scene(61);
  const GapReport report = diagnose(changed(scene, 71,
    [](double u, int, int x, int y, double) { return isInSpot(x, y) ? 0.95 : exponent(u); }));
  SCOPED_TRACE(describe(report));
  expectFirst(report, "detector_nonlinearity", "level");
  expectParameter(report, "detector_nonlinearity", "exponent", 0.93, 0.003);
  EXPECT_TRUE(says(report, "Odd? "));
  EXPECT_TRUE(
    says(report, "% of the pixels looked at left out: far from what is found in all others"));
  EXPECT_TRUE(says(report, "x -0.5")); // the spot's middle is at -0.54, -0.13
}

TEST(FieldMistakes, ASpotAloneIsTheGap)
{
  const TestScene scene(62);
  const GapReport report = diagnose(changed(
    scene, 72, [](double u, int, int x, int y, double) { return isInSpot(x, y) ? 0.95 : u; }));
  SCOPED_TRACE(describe(report));
  EXPECT_NE(report.verdict, GapVerdict::NoGap);
  EXPECT_NE(report.verdict, GapVerdict::Explained);
  EXPECT_TRUE(says(report, "% of the pixels looked at, without which there is no gap: far"));
}

// Highlights of some ten pixels all over the image, which the simulation does not have: nearly every third block has one.
TEST(FieldMistakes, HighlightsEverywhereAreLeftOut)
{
  const TestScene scene(66);
  TestPair pair = changed(scene, 77, [](double u, int, int, int, double) { return exponent(u); });
  const msi::CounterRandom random(78);
  for (std::uint64_t n = 0; n < 24; ++n)
  {
    const double x = random.uniform(2 * n) * scene.width();
    const double y = random.uniform(2 * n + 1) * scene.height();
    paint(
      pair, scene, [&](int i, int j) { return std::hypot(i - x, j - y) < 2.0; }, 0.95F);
  }
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  expectFirst(report, "detector_nonlinearity", "level");
  expectParameter(report, "detector_nonlinearity", "exponent", 0.93, 0.004);
  EXPECT_TRUE(says(report, "% of the pixels looked at left out"));
}

// One value of 500 is white or black, as in a sensor with hot and dead pixels, now and then two beside each other.
TEST(FieldMistakes, HotAndDeadPixelsTakeNoPart)
{
  const TestScene scene(65);
  const TestPair clean =
    changed(scene, 75, [](double u, int, int, int, double) { return exponent(u); });
  TestPair pair = clean;
  const msi::CounterRandom random(76);
  for (std::size_t i = 0; i < pair.real.size(); ++i)
  {
    const double chance = random.uniform(i);
    pair.real[i] = chance < 0.001 ? 1.0F : chance > 0.999 ? 0.0F : pair.real[i];
  }
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  expectFirst(report, "detector_nonlinearity", "level");
  expectParameter(report, "detector_nonlinearity", "exponent", 0.93, 0.003);
  EXPECT_NEAR(report.gap.rmsAfter, diagnose(clean).gap.rmsAfter, 0.0002);
  EXPECT_TRUE(says(report, "stand out from all of their neighbours"));
  EXPECT_FALSE(says(diagnose(clean), "stand out from all of their neighbours"));
}

// Registration moves an image and fills what comes in from outside with 0.
TEST(FieldMistakes, AFrameOfZerosTakesNoPart)
{
  const TestScene scene(63);
  TestPair pair = changed(scene, 73, [](double u, int, int, int, double) { return exponent(u); });
  paint(
    pair, scene, [&](int x, int y) { return x < 18 || y >= scene.height() - 12; }, 0.0F);
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  expectFirst(report, "detector_nonlinearity", "level");
  EXPECT_TRUE(says(report, "a frame of 18 % of the pixels is 0 in all channels"));
  // Dark where the simulated image is dark, too, it is none.
  for (std::size_t i = 0; i < pair.real.size(); ++i)
  {
    pair.simulated[i] = pair.real[i] == 0.0F ? 0.001F : pair.simulated[i];
  }
  EXPECT_FALSE(says(diagnose(pair), "a frame of"));
}

// In percent or in counts of full scale, effects are what they are relative to white.
TEST(FieldMistakes, OtherUnitsChangeNothing)
{
  const TestScene scene(64);
  const TestPair pair =
    changed(scene, 74, [](double u, int, int, int, double) { return 1.05 * u; });
  for (const float scale : { 100.0F, 65535.0F, 4095.0F / 65535.0F })
  {
    TestPair other = pair;
    for (float& value : other.real)
    {
      value *= scale;
    }
    const GapReport report = diagnose(other);
    SCOPED_TRACE(describe(report));
    expectFirst(report, "exposure_gain", "level");
    expectParameter(report, "exposure_gain", "gain", 1.05, 0.002);
    EXPECT_TRUE(says(report, "Units? The real image is not in units of white"));
  }
}

// Another exposure must not hide what else there is.
TEST(FieldMistakes, AnEffectBesideALargeGain)
{
  const TestScene scene(65);
  const std::vector<double> channels{ 0.4, 1.7, 0.6 };
  for (const std::vector<double>& gains :
    { std::vector<double>(3, 0.5), std::vector<double>(3, 3.0), channels })
  {
    const GapReport report = diagnose(changed(scene, 75,
      [&scene, &gains](double u, int k, int x, int y, double)
      {
        return gains[static_cast<std::size_t>(k)] * u *
          (1.0 - 0.08 * (std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2)));
      }));
    SCOPED_TRACE(describe(report));
    ASSERT_EQ(report.causes.size(), 2U);
    EXPECT_EQ(report.causes[0].effect, gains == channels ? "channel_gain" : "exposure_gain");
    EXPECT_EQ(report.causes[1].effect, "vignetting");
    EXPECT_GT(report.causes[1].probability, 0.9);
  }
}

TEST(FieldMistakes, ADeadChannelIsNamed)
{
  const TestScene scene(66);
  for (const float dead : { 0.0F, 0.001F }) // with noise, and the same everywhere
  {
    TestPair pair = changed(
      scene, 76, [](double u, int k, int, int, double) { return k == 1 ? 0.0 : exponent(u); });
    for (std::size_t i = 1; dead > 0.0F && i < pair.real.size(); i += 3)
    {
      pair.real[i] = dead;
    }
    const GapReport report = diagnose(pair);
    SCOPED_TRACE(describe(report));
    EXPECT_TRUE(says(report, "Dead? Channel C2 does not change with the scene"));
    expectFirst(report, "detector_nonlinearity", "level");
    EXPECT_FALSE(says(report, "units of white"));
    EXPECT_LT(report.gap.rmsBefore, 1.0);
  }
}

// A scene without contrast has no slope by which its unit could be told.
TEST(FieldMistakes, AFlatField)
{
  const TestScene scene(67, 3, 96, 80);
  TestPair pair = changed(scene, 77, [](double u, int, int, int, double) { return u; });
  const msi::CounterRandom random(5);
  for (std::size_t i = 0; i < pair.real.size(); ++i)
  {
    pair.simulated[i] = 0.4F;
    pair.real[i] = static_cast<float>(0.4 + 0.003 * random.normal(i));
  }
  const GapReport report = diagnose(pair);
  EXPECT_EQ(report.verdict, GapVerdict::NoGap) << describe(report);
  EXPECT_FALSE(says(report, "units of white"));
}

TEST(FieldMistakes, TheSameImageTwiceIsNoGap)
{
  const TestScene scene(72, 3, 96, 80);
  TestPair pair = changed(scene, 73, [](double u, int, int, int, double) { return u; });
  pair.real = pair.simulated;
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.verdict, GapVerdict::NoGap);
  EXPECT_GE(report.probabilityOf("nothing"), 0.9); // a number at all
}

// Dark counts over those of white, as with a filter wheel whose exposures differ: they follow a curve over the channels.
TEST(FieldMistakes, ADarkFrameThatWasForgotten)
{
  const TestScene scene(68, 8, 120, 100);
  const GapReport report = diagnose(changed(scene, 78,
    [](double u, int k, int, int, double) { return u + 0.012 + 0.0012 * std::pow(k - 3.0, 2); }));
  expectFirst(report, "dark_offset", "channel");
  EXPECT_LT(report.probabilityOf("unknown"), 0.1);
}

// In one image the gain of the pixels looks like noise, but for what the channels share.
TEST(FieldMistakes, APatternOfThePixelsIsToldOf)
{
  const TestScene scene(69);
  const msi::CounterRandom random(6);
  for (const double size : { 0.0, 0.03 })
  {
    const GapReport report = diagnose(changed(scene, 79,
      [&](double u, int, int x, int y, double)
      { return u * (1.0 + size * random.normal(static_cast<std::uint64_t>(1000 * y + x))); }));
    SCOPED_TRACE(describe(report));
    EXPECT_EQ(says(report, "is the same in all channels, and counts as noise"), size > 0.0);
  }
}

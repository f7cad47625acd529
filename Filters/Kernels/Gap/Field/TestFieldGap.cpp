#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace
{
using msi::GapReport;
using msi::GapVerdict;
using namespace msi::test;
}

// Patches whose color is simulated wrongly, each in its own way, are no effect of the camera.
TEST(FieldGap, ColorsOffPatchByPatchAreNoEffect)
{
  int blamed = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed)
  {
    const TestScene scene(400 + seed, 4);
    const msi::CounterRandom random(seed, 9);
    const auto patchOf = [](int x, int y) { return x / 24 + 8 * (y / 24); };
    TestPair pair = changed(scene, 500 + seed,
      [&](double u, int k, int x, int y, double)
      {
        const auto patch = static_cast<std::uint64_t>(patchOf(x, y));
        return u * (1.0 + 0.06 * random.normal(patch * 4 + static_cast<std::uint64_t>(k)));
      });
    for (int y = 0; y < scene.height(); ++y)
    {
      for (int x = 0; x < scene.width(); ++x)
      {
        pair.labels.push_back(1 + patchOf(x, y));
      }
    }
    const GapReport report = diagnose(pair);
    EXPECT_EQ(report.where.front().axis, "sample") << describe(report);
    EXPECT_NE(report.verdict, GapVerdict::NoGap) << describe(report);
    blamed += report.causes.empty() ? 0 : 1;
  }
  EXPECT_LE(blamed, 1);
}

TEST(FieldGap, ScenesThatShowLittle)
{
  const TestScene scene(37, 1, 96, 80);
  TestPair pair = changed(scene, 48, [](double u, int, int, int, double) { return u; });
  EXPECT_EQ(diagnose(pair).verdict, GapVerdict::NoGap); // one channel
  std::fill(pair.simulated.begin(), pair.simulated.end(), 0.5F);
  pair.real = pair.simulated;
  EXPECT_EQ(diagnose(pair).verdict, GapVerdict::NoGap);
  for (float& value : pair.real)
  {
    value *= 0.9F;
  }
  const GapReport constant = diagnose(pair);
  EXPECT_EQ(constant.verdict, GapVerdict::Explained) << describe(constant);
  EXPECT_FALSE(constant.causes.front().equivalent.empty()) << describe(constant);
  std::fill(pair.simulated.begin(), pair.simulated.end(), 0.0F);
  EXPECT_NE(diagnose(pair).verdict, GapVerdict::NoGap);
}

TEST(FieldGap, SeveralEffectsAtOnce)
{
  const TestScene scene(13);
  const double gain[] = { 0.97, 1.0, 1.04 };
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      ImagePlane plane = scene.pixels(gaussianBlurred(scene.fine(k), 1.0 * TestScene::Fine));
      for (int y = 0; y < plane.height; ++y)
      {
        for (int x = 0; x < plane.width; ++x)
        {
          const double rho2 = std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2);
          plane.at(x, y) *=
            gain[k] * (1.0 - 0.1 * rho2) * (1.0 + 0.01 * std::sin(2.0 * Pi * y / 9.0));
        }
      }
      return plane;
    },
    24);
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_EQ(report.causes.size(), 4U);
  expectParameter(report, "vignetting", "falloff", 0.1, 0.003);
  expectParameter(report, "channel_gain", "gain[C1]", 0.97, 0.003);
  expectParameter(report, "banding", "period", 9.0, 0.05);
  expectParameter(report, "defocus", "blur", 1.0, 0.03);
}

TEST(FieldGap, AnImageUpsideDownIsSaidToBe)
{
  const TestScene scene(14);
  TestPair pair = changed(scene, 25, [](double u, int, int, int, double) { return u; });
  const auto said = [&pair]
  {
    const std::vector<std::string> notes = diagnose(pair).notes;
    return std::count(
      notes.begin(), notes.end(), "Mixed up? The real image fits much better upside down.");
  };
  EXPECT_EQ(said(), 0);
  const auto row = static_cast<std::ptrdiff_t>(pair.extent.width * scene.channels());
  for (std::ptrdiff_t y = 0; y < pair.extent.height / 2; ++y)
  {
    std::swap_ranges(pair.real.begin() + y * row, pair.real.begin() + (y + 1) * row,
      pair.real.end() - (y + 1) * row);
  }
  EXPECT_EQ(said(), 1);
}

// There a few scenes are enough to run every path.
#ifdef __SANITIZE_ADDRESS__
constexpr bool UnderSanitizers = true;
#else
constexpr bool UnderSanitizers = false;
#endif

TEST(FieldGap, QuietWithoutEffect)
{
  constexpr std::uint64_t Scenes = UnderSanitizers ? 3 : 12; // these tell a false-alarm rate
  int blamed = 0;
  for (std::uint64_t seed = 0; seed < Scenes; ++seed)
  {
    const TestScene scene(100 + seed, 3, seed % 2 == 0 ? 128 : 112, seed % 2 == 0 ? 112 : 96);
    const GapReport report =
      diagnose(changed(scene, 200 + seed, [](double u, int, int, int, double) { return u; }));
    SCOPED_TRACE(describe(report));
    blamed += report.verdict != GapVerdict::NoGap || !report.causes.empty() ? 1 : 0;
    EXPECT_NEAR(report.gap.noiseFloor, report.gap.rmsBefore, 0.03 * report.gap.rmsBefore);
  }
  EXPECT_LE(blamed, 1);
}

// As demosaicing and denoising leave it: each pixel's noise is a mean over its 3 x 3 neighbours.
TEST(FieldGap, QuietWithNoiseThatNeighboursShare)
{
  constexpr std::uint64_t Scenes = UnderSanitizers ? 1 : 4;
  for (std::uint64_t seed = 0; seed < Scenes; ++seed)
  {
    const TestScene scene(140 + seed);
    TestPair pair = changed(scene, 240 + seed, [](double u, int, int, int, double) { return u; });
    const msi::CounterRandom random(seed, 7);
    for (int y = 1; y + 1 < scene.height(); ++y)
    {
      for (int x = 1; x + 1 < scene.width(); ++x)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          double sum = 0.0;
          for (const int dy : { -1, 0, 1 })
          {
            for (const int dx : { -1, 0, 1 })
            {
              sum += random.normal(pair.pair().index(x + dx, y + dy) * 3 + k);
            }
          }
          pair.real[pair.pair().index(x, y) * 3 + k] += static_cast<float>(0.008 * sum / 3.0);
        }
      }
    }
    const GapReport report = diagnose(pair);
    SCOPED_TRACE(describe(report));
    EXPECT_EQ(report.verdict, GapVerdict::NoGap);
    EXPECT_NEAR(report.gap.noiseFloor, report.gap.rmsBefore, 0.05 * report.gap.rmsBefore);
  }
}

TEST(FieldGap, UnknownEffectsStayUnknown)
{
  const TestScene scene(14);
  const ImagePlane ghost = scene.pixels(scene.fine(0));
  const TestPair mirrored = changed(scene, 25,
    [&](double u, int, int x, int y, double)
    { return u + 0.08 * ghost.read(scene.width() - 1 - x, scene.height() - 1 - y); });
  const GapReport reflection = diagnose(mirrored);
  EXPECT_NE(reflection.verdict, GapVerdict::Explained) << describe(reflection);
  EXPECT_NE(reflection.verdict, GapVerdict::NoGap) << describe(reflection);
  EXPECT_GT(reflection.unexplained.share, 0.15) << describe(reflection);

  const TestPair stained = changed(scene, 26,
    [&](double u, int, int x, int y, double)
    {
      const double distance2 = std::pow(x - 60.0, 2) + std::pow(y - 50.0, 2);
      return u * (1.0 - 0.15 * std::exp(-distance2 / (2.0 * 18.0 * 18.0)));
    });
  const GapReport stain = diagnose(stained);
  EXPECT_GT(stain.unexplained.share, 0.5) << describe(stain);
  EXPECT_TRUE(
    stain.verdict == GapVerdict::Unexplained || stain.verdict == GapVerdict::PartlyExplained)
    << describe(stain);
}

TEST(FieldGap, LeavesOutWhatIsAskedFor)
{
  const TestScene scene(15);
  const TestPair pair = changed(scene, 27,
    [&](double u, int, int x, int y, double)
    { return u * (1.0 - 0.15 * (std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2))); });
  msi::GapOptions options;
  options.without = { "vignetting", "illumination_gradient" };
  const GapReport report = msi::diagnoseField(pair.pair(), options)->report;
  SCOPED_TRACE(describe(report));
  for (const auto& cause : report.causes)
  {
    EXPECT_NE(cause.effect, "vignetting");
    EXPECT_NE(cause.effect, "illumination_gradient");
    EXPECT_LT(cause.share, 0.5);
  }
  EXPECT_NE(report.verdict, GapVerdict::Explained);
  EXPECT_NE(report.verdict, GapVerdict::NoGap);
}

// An exposure that may not be blamed is no lamp that is brighter either.
TEST(FieldGap, LeavesOutGainsInDisguise)
{
  const TestScene scene(64, 5);
  const TestPair pair =
    changed(scene, 74, [](double u, int, int, int, double) { return 0.93 * u; });
  msi::GapOptions options;
  options.without = { "exposure_gain" };
  const GapReport report = msi::diagnoseField(pair.pair(), options)->report;
  SCOPED_TRACE(describe(report));
  EXPECT_EQ(report.probabilityOf("exposure_gain"), 0.0);
  EXPECT_LT(report.probabilityOf("illuminant_drift"), 0.1);
}

// A chart on a black cloth that was not simulated: patches of constant color, holes in the real image.
TEST(FieldGap, PatchesAmongGaps)
{
  const TestScene scene(16);
  TestPair pair = changed(scene, 28,
    [&](double u, int, int x, int, double) { return u * (1.0 + 0.08 * scene.fieldX(x)); });
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const msi::CounterRandom random(3);
  for (int y = 0; y < scene.height(); ++y)
  {
    for (int x = 0; x < scene.width(); ++x)
    {
      const int patch = x / 30 + 6 * (y / 30);
      const bool inside = x % 30 < 22 && y % 30 < 22;
      pair.labels.push_back(inside ? patch + 1 : 0);
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::size_t i = pair.pair().index(x, y) * 3 + k;
        const double level = 0.1 + 0.7 * random.uniform(static_cast<std::uint64_t>(patch), k);
        const double noise = 0.003 * random.normal(1000 + i);
        pair.simulated[i] = inside ? static_cast<float>(level) : nan;
        pair.real[i] = x % 17 == 3 && y % 13 == 5
          ? nan
          : static_cast<float>(level * (1.0 + 0.08 * scene.fieldX(x)) + noise);
      }
    }
  }
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "illumination_gradient");
  EXPECT_EQ(report.causes.size(), 1U);
  expectParameter(report, "illumination_gradient", "along_x", 0.08, 0.002);
  const auto says = [&report](const char* words)
  {
    return std::any_of(report.notes.begin(), report.notes.end(),
      [words](const std::string& note) { return note.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says("misregistration cannot be decided"));
  EXPECT_TRUE(says("defocus cannot be decided"));
  EXPECT_TRUE(says("% of the pixels can be used"));
}

TEST(FieldGap, FewPixels)
{
  const TestScene scene(17, 3, 24, 20);
  const GapReport report =
    diagnose(changed(scene, 29, [](double u, int, int, int, double) { return 0.9 * u; }));
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "exposure_gain");
  expectParameter(report, "exposure_gain", "gain", 0.9, 0.01);
}

TEST(FieldGap, ErrorsSayWhatWasExpected)
{
  const auto messageOf = [](const msi::FieldPair& pair, const msi::GapOptions& options = {})
  {
    try
    {
      msi::diagnoseField(pair, options);
    }
    catch (const std::invalid_argument& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  const TestScene scene(18, 2, 40, 30);
  TestPair pair = changed(scene, 30, [](double u, int, int, int, double) { return u; });
  msi::FieldPair empty = pair.pair();
  empty.extent = { 0, 30 };
  EXPECT_EQ(messageOf(empty),
    "the images have 0 x 30 pixels and 2 channels; expected at least one of each");
  msi::GapOptions options;
  options.without = { "gremlins" };
  EXPECT_EQ(messageOf(pair.pair(), options), "there is no effect 'gremlins' to leave out");
  TestPair counts = pair;
  std::fill(counts.simulated.begin(), counts.simulated.end(), 750.0F);
  EXPECT_EQ(messageOf(counts.pair()),
    "the simulated image has a mean of 750, which looks like counts; expected responses relative "
    "to white (1 = perfect white): divide both images by the counts of white");
  std::fill(pair.real.begin(), pair.real.end(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(messageOf(pair.pair()),
    "the images share 0 blocks of 4 x 4 usable pixels; expected at least 15: pixels must be finite "
    "in "
    "both images, with finite neighbours in the simulated one");
}

TEST(FieldGap, StopsWhenAsked)
{
  const TestScene scene(19, 2, 64, 64);
  const TestPair pair = changed(scene, 31, [](double u, int, int, int, double) { return 0.9 * u; });
  msi::GapOptions options;
  options.progress = [](double fraction, const char*) { return fraction < 0.1; };
  EXPECT_FALSE(msi::diagnoseField(pair.pair(), options));
}

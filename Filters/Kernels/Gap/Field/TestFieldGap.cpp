#include "Kernels/Gap/Field/FieldGap.h"
#include "Kernels/Gap/Field/FieldTestScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace
{
using msi::FieldGap;
using msi::GapReport;
using msi::GapVerdict;
using msi::test::findParameter;
using msi::test::gaussianBlurred;
using msi::test::ImagePlane;
using msi::test::makePair;
using msi::test::meanOf;
using msi::test::Pi;
using msi::test::TestPair;
using msi::test::TestScene;

std::string describe(const GapReport& report)
{
  std::ostringstream text;
  text << nameOf(report.verdict) << ": rms " << report.gap.rmsBefore << " -> "
       << report.gap.rmsAfter << ", floor " << report.gap.noiseFloor << ", shrink "
       << report.gap.shrink << "\n";
  for (const auto& axis : report.where)
  {
    text << "  where " << axis.axis << " " << axis.share << "\n";
  }
  for (const auto& cause : report.causes)
  {
    text << "  cause " << cause.effect << " (" << cause.form << ") share " << cause.share;
    for (const auto& name : cause.equivalent)
    {
      text << " ~" << name;
    }
    for (const auto& parameter : cause.parameters)
    {
      text << "\n    " << parameter.name << " " << parameter.value << " +- "
           << parameter.standardError;
    }
    text << "\n";
  }
  for (const auto& note : report.notes)
  {
    text << "  note " << note << "\n";
  }
  return text.str();
}

// Within four standard errors or the tolerance that the forms' approximations leave.
void expectParameter(const GapReport& report, const std::string& effect, const std::string& name,
  double planted, double tolerance)
{
  const msi::GapParameter* parameter = findParameter(report, effect, name);
  ASSERT_NE(parameter, nullptr) << effect << " " << name;
  EXPECT_NEAR(parameter->value, planted, std::fmax(tolerance, 4.0 * parameter->standardError))
    << effect << " " << name;
}

void expectFirst(
  const GapReport& report, const std::string& effect, const char* axis, double shrink = 0.85)
{
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, effect);
  EXPECT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_GT(report.gap.shrink, shrink);
  ASSERT_FALSE(report.where.empty());
  EXPECT_EQ(report.where.front().axis, axis);
  EXPECT_EQ(report.candidates.front().effect, effect);
}

// Every pixel of the nominal image through change(u, channel, x, y, mean of the channel).
template <typename Change>
TestPair changed(const TestScene& scene, std::uint64_t seed, Change change)
{
  return makePair(
    scene,
    [&](int k)
    {
      ImagePlane plane = scene.pixels(scene.fine(k));
      const double mean = meanOf(plane);
      for (int y = 0; y < plane.height; ++y)
      {
        for (int x = 0; x < plane.width; ++x)
        {
          plane.at(x, y) = change(plane.at(x, y), k, x, y, mean);
        }
      }
      return plane;
    },
    seed);
}

GapReport diagnose(const TestPair& pair)
{
  return msi::diagnoseField(pair.pair())->report;
}
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

TEST(FieldGap, GradientIsAPlane)
{
  const TestScene scene(2);
  const TestPair pair = changed(scene, 12,
    [&](double u, int, int x, int y, double)
    { return u * (1.0 + 0.05 * scene.fieldX(x) - 0.03 * scene.fieldY(y)); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "illumination_gradient", "position");
  expectParameter(report, "illumination_gradient", "right", 0.05, 0.002);
  expectParameter(report, "illumination_gradient", "down", -0.03, 0.002);
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

TEST(FieldGap, OffsetsOfChannelsMayBeGlare)
{
  const TestScene scene(4);
  const double offset[] = { 0.004, 0.012, -0.006 };
  const TestPair pair =
    changed(scene, 14, [&](double u, int k, int, int, double) { return u + offset[k]; });
  const GapReport report = diagnose(pair);
  expectFirst(report, "dark_offset", "channel");
  expectParameter(report, "dark_offset", "offset[C2]", 0.012, 0.0005);
  EXPECT_EQ(report.causes.front().equivalent, std::vector<std::string>{ "veiling_glare" });
  ASSERT_TRUE(report.nextCapture);
  EXPECT_EQ(report.nextCapture->capture, "lens cap");
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

TEST(FieldGap, DefocusOfEachChannel)
{
  const TestScene scene(7);
  const double blur[] = { 0.0, 0.8, 1.3 };
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      const ImagePlane sharp = scene.fine(k);
      return scene.pixels(
        blur[k] > 0.0 ? gaussianBlurred(sharp, blur[k] * TestScene::Fine) : sharp);
    },
    17);
  const GapReport report = diagnose(pair);
  expectFirst(report, "defocus", "edges");
  expectParameter(report, "defocus", "blur[C2]", 0.8, 0.03);
  expectParameter(report, "defocus", "blur[C3]", 1.3, 0.03);
}

TEST(FieldGap, MisregistrationOfEachChannel)
{
  const TestScene scene(8);
  const double right[] = { 0.4, 0.0, -1.3 };
  const double down[] = { -0.25, 0.0, 0.7 };
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      return scene.pixels(scene.fine(
        k, [&](double x, double y) { return std::make_pair(x - right[k], y - down[k]); }));
    },
    18);
  const GapReport report = diagnose(pair);
  expectFirst(report, "misregistration", "edges");
  expectParameter(report, "misregistration", "right[C1]", 0.4, 0.02);
  expectParameter(report, "misregistration", "down[C1]", -0.25, 0.02);
  expectParameter(report, "misregistration", "right[C3]", -1.3, 0.02);
  expectParameter(report, "misregistration", "down[C3]", 0.7, 0.02);
}

TEST(FieldGap, DisplacementOfManyPixels)
{
  const TestScene scene(9);
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      return scene.pixels(scene.fine(k,
        [&](double x, double y)
        { return std::make_pair(x - 6.3 * (k == 1), y + 4.6 * (k == 1)); }));
    },
    19);
  const GapReport report = diagnose(pair);
  expectFirst(report, "misregistration", "edges");
  expectParameter(report, "misregistration", "right[C2]", 6.3, 0.02);
  expectParameter(report, "misregistration", "down[C2]", -4.6, 0.02);
}

TEST(FieldGap, LateralColor)
{
  const TestScene scene(10);
  const double growth[] = { 0.004, 0.0, -0.006 };
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      const double middleX = 0.5 * (scene.width() - 1);
      const double middleY = 0.5 * (scene.height() - 1);
      return scene.pixels(scene.fine(k,
        [&](double x, double y)
        {
          return std::make_pair(middleX + (x - middleX) / (1.0 + growth[k]),
            middleY + (y - middleY) / (1.0 + growth[k]));
        }));
    },
    20);
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "misregistration");
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  expectParameter(report, "misregistration", "magnification[C1]", 0.004, 0.0003);
  expectParameter(report, "misregistration", "magnification[C3]", -0.006, 0.0003);
}

TEST(FieldGap, LocalStrayLightIsABroadTail)
{
  // Gaussians of the deviations and weights that ScatterTail states, for a radius of 6 pixels.
  const TestScene scene(11);
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      ImagePlane plane = scene.pixels(scene.fine(k));
      const ImagePlane sharp = plane;
      std::vector<double> weight;
      double sum = 0.0;
      for (int pass = 1; pass <= 6; ++pass)
      {
        const double deviation = std::sqrt((std::pow(4.0, pass) - 1.0) / 3.0);
        weight.push_back(std::pow(0.5, pass) * std::exp(-deviation / 12.0));
        sum += weight.back();
      }
      for (double& value : plane.value)
      {
        value *= 1.0 - 0.08;
      }
      for (int pass = 1; pass <= 6; ++pass)
      {
        const double deviation = std::sqrt((std::pow(4.0, pass) - 1.0) / 3.0);
        const ImagePlane wide = gaussianBlurred(sharp, deviation);
        for (std::size_t i = 0; i < plane.value.size(); ++i)
        {
          plane.value[i] += 0.08 * weight[static_cast<std::size_t>(pass - 1)] / sum * wide.value[i];
        }
      }
      return plane;
    },
    21);
  const GapReport report = diagnose(pair);
  // Gaussians are not quite the library's splines.
  expectFirst(report, "local_stray_light", "edges", 0.6);
  expectParameter(report, "local_stray_light", "fraction", 0.08, 0.006);
  expectParameter(report, "local_stray_light", "radius", 6.0, 1.0);
}

TEST(FieldGap, LagOfTheChannelBefore)
{
  const TestScene scene(31, 4);
  std::vector<ImagePlane> planes;
  for (int k = 0; k < scene.channels(); ++k)
  {
    planes.push_back(scene.pixels(scene.fine(k)));
  }
  const TestPair pair = changed(scene, 41,
    [&](double u, int k, int x, int y, double)
    { return u + (k > 0 ? 0.05 * planes[static_cast<std::size_t>(k) - 1].read(x, y) : 0.0); });
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "lag");
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  expectParameter(report, "lag", "retained", 0.05, 0.001);
}

// Few pixels are that bright; all others are as they were.
TEST(FieldGap, SaturationOfTheBrightest)
{
  const TestScene scene(32);
  const TestPair pair =
    changed(scene, 42, [](double u, int, int, int, double) { return std::fmin(u, 0.45); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "saturation", "level");
  expectParameter(report, "saturation", "level", 0.45, 0.005);
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

// exp(-distance / radius), summed in the plane by plain loops: no sum of splines.
TEST(FieldGap, LocalStrayLightOfAnotherShape)
{
  const TestScene scene(34, 2, 128, 112);
  constexpr int Reach = 24;
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      const ImagePlane sharp = scene.pixels(scene.fine(k));
      ImagePlane plane = sharp;
      std::vector<double> weight;
      double sum = 0.0;
      for (int j = -Reach; j <= Reach; ++j)
      {
        for (int i = -Reach; i <= Reach; ++i)
        {
          weight.push_back(std::exp(-std::hypot(i, j) / 5.0));
          sum += weight.back();
        }
      }
      for (int y = 0; y < plane.height; ++y)
      {
        for (int x = 0; x < plane.width; ++x)
        {
          double wide = 0.0;
          std::size_t n = 0;
          for (int j = -Reach; j <= Reach; ++j)
          {
            for (int i = -Reach; i <= Reach; ++i)
            {
              wide += weight[n++] * sharp.read(x + i, y + j);
            }
          }
          plane.at(x, y) += 0.2 * (wide / sum - plane.at(x, y));
        }
      }
      return plane;
    },
    45);
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "local_stray_light");
  EXPECT_EQ(report.causes.front().form, "neighbours");
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_GT(report.gap.shrink, 0.9);
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
  expectParameter(report, "illumination_gradient", "right", -0.07, 0.002);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes.front().find("not in units of white"), std::string::npos);
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

TEST(FieldGap, BandingOfRowsAndOfColumns)
{
  const TestScene scene(12);
  const double start[] = { 0.1, 0.45, 0.8 };
  const TestPair rows = changed(scene, 22,
    [&](double u, int k, int, int y, double)
    { return u * (1.0 + 0.012 * std::sin(2.0 * Pi * (y / 11.3 + start[k]))); });
  const GapReport report = diagnose(rows);
  expectFirst(report, "banding", "rows");
  EXPECT_EQ(report.causes.front().form, "rows");
  expectParameter(report, "banding", "period", 11.3, 0.05);
  expectParameter(report, "banding", "amplitude[C1]", 0.012, 0.001);
  expectParameter(report, "banding", "start[C2]", 0.45, 0.04);

  const TestPair columns = changed(scene, 23,
    [&](double u, int k, int x, int, double)
    { return u * (1.0 + 0.012 * std::sin(2.0 * Pi * (x / 7.7 + start[k]))); });
  const GapReport other = diagnose(columns);
  expectFirst(other, "banding", "columns");
  expectParameter(other, "banding", "period", 7.7, 0.05);
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

TEST(FieldGap, QuietWithoutEffect)
{
  // Twelve scenes tell a false-alarm rate; under the sanitizers three are enough to run every path.
#ifdef __SANITIZE_ADDRESS__
  constexpr std::uint64_t Scenes = 3;
#else
  constexpr std::uint64_t Scenes = 12;
#endif
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
  options.without = { "vignetting" };
  const GapReport report = msi::diagnoseField(pair.pair(), options)->report;
  SCOPED_TRACE(describe(report));
  for (const auto& cause : report.causes)
  {
    EXPECT_NE(cause.effect, "vignetting");
    EXPECT_LT(cause.share, 0.5);
  }
  EXPECT_NE(report.verdict, GapVerdict::Explained);
  EXPECT_NE(report.verdict, GapVerdict::NoGap);
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
  expectParameter(report, "illumination_gradient", "right", 0.08, 0.002);
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
  EXPECT_EQ(report.causes.size(), 2U);
  expectParameter(report, "vignetting", "falloff", 0.06, 0.002);
  expectParameter(report, "illumination_gradient", "down", 0.03, 0.002);
}

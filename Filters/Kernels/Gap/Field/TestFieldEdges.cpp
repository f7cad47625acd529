#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace
{
using msi::GapReport;
using msi::GapVerdict;
using namespace msi::test;
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

// A blurred copy has less of the noise, and so less of a gap: that is no blur. Where there is one, it is found as it is.
TEST(FieldGap, NoiseOfTheSimulatedImageIsNoBlur)
{
  const TestScene scene(9);
  const double blur = 0.8;
  for (const bool blurred : { false, true })
  {
    TestPair pair = makePair(
      scene,
      [&](int k)
      {
        const ImagePlane sharp = scene.fine(k);
        return scene.pixels(blurred ? gaussianBlurred(sharp, blur * TestScene::Fine) : sharp);
      },
      19);
    const msi::CounterRandom random(20);
    for (std::size_t i = 0; i < pair.simulated.size(); ++i)
    {
      pair.simulated[i] += static_cast<float>(0.005 * random.normal(i));
    }
    const GapReport report = diagnose(pair);
    SCOPED_TRACE(describe(report));
    // To a tenth.
    EXPECT_TRUE(std::any_of(report.notes.begin(), report.notes.end(),
      [](const std::string& note)
      {
        const std::string words = "the simulated image has noise of its own, ";
        return note.find(words) == 0 &&
          std::fabs(std::stod(note.substr(words.size())) - 0.005) < 0.0005;
      }));
    EXPECT_EQ(report.causes.size(), blurred ? 1U : 0U);
    EXPECT_EQ(report.verdict, blurred ? GapVerdict::Explained : GapVerdict::NoGap);
    if (blurred)
    {
      expectParameter(report, "defocus", "blur", blur, 0.03);
    }
  }
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
  expectParameter(report, "misregistration", "along_x[C1]", 0.4, 0.02);
  expectParameter(report, "misregistration", "along_y[C1]", -0.25, 0.02);
  expectParameter(report, "misregistration", "along_x[C3]", -1.3, 0.02);
  expectParameter(report, "misregistration", "along_y[C3]", 0.7, 0.02);
}

// As many numbers as 40: more than what a residual is taken to tell, but each of them shows.
TEST(FieldGap, MisregistrationOfManyChannels)
{
  const TestScene scene(62, 20, 112, 96);
  const msi::CounterRandom random(62, 1);
  const auto displacement = [&](int k, std::uint64_t axis)
  { return 0.5 * random.normal(2 * static_cast<std::uint64_t>(k) + axis); };
  const TestPair pair = makePair(
    scene,
    [&](int k)
    {
      return scene.pixels(scene.fine(k,
        [&](double x, double y)
        { return std::make_pair(x - displacement(k, 0), y - displacement(k, 1)); }));
    },
    72);
  const GapReport report = diagnose(pair);
  expectFirst(report, "misregistration", "edges");
  EXPECT_LT(report.probabilityOf("unknown"), 0.3);
  expectParameter(report, "misregistration", "along_x[C7]", displacement(6, 0), 0.03);
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
  expectParameter(report, "misregistration", "along_x[C2]", 6.3, 0.02);
  expectParameter(report, "misregistration", "along_y[C2]", -4.6, 0.02);
  EXPECT_GT(report.where.front().share, 0.85); // however far
}

namespace
{
// How a channel lies: moved to the right (pixels), larger by this part of its size and turned (degrees) about the middle.
struct Place
{
  double right, growth, degrees;
};

TestPair placed(const TestScene& scene, const std::vector<Place>& channels, std::uint64_t seed)
{
  return makePair(
    scene,
    [&](int k)
    {
      const Place& place = channels[static_cast<std::size_t>(k)];
      const double middleX = 0.5 * (scene.width() - 1);
      const double middleY = 0.5 * (scene.height() - 1);
      const double cosine = std::cos(place.degrees * Pi / 180.0) / (1.0 + place.growth);
      const double sine = std::sin(place.degrees * Pi / 180.0) / (1.0 + place.growth);
      return scene.pixels(scene.fine(k,
        [&](double x, double y)
        {
          const double offX = x - middleX - place.right;
          const double offY = y - middleY;
          return std::make_pair(
            middleX + cosine * offX + sine * offY, middleY - sine * offX + cosine * offY);
        }));
    },
    seed);
}
}

TEST(FieldGap, LateralColor)
{
  const GapReport report = diagnose(
    placed(TestScene(10), { { 0.0, 0.004, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0, -0.006, 0.0 } }, 20));
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "misregistration");
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  expectParameter(report, "misregistration", "magnification[C1]", 0.004, 0.0003);
  expectParameter(report, "misregistration", "magnification[C3]", -0.006, 0.0003);
}

// The camera stood nearer.
TEST(FieldGap, AnImageThatIsMuchLarger)
{
  const Place near{ 0.0, 0.05, 0.0 };
  const GapReport report = diagnose(placed(TestScene(10), { near, near, near }, 20));
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "misregistration");
  EXPECT_GT(report.gap.shrink, 0.9);
  EXPECT_EQ(report.causes.front().form, "common");
  expectParameter(report, "misregistration", "magnification", 0.05, 0.0005);
}

// Numbers of their own for each of many channels would be too many to be believed.
TEST(FieldGap, ACameraThatWasMoved)
{
  const Place moved{ 2.3, -0.004, 0.2 };
  const GapReport report = diagnose(placed(TestScene(15, 8), std::vector<Place>(8, moved), 25));
  SCOPED_TRACE(describe(report));
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "misregistration");
  EXPECT_EQ(report.causes.front().form, "common");
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_GT(report.probabilityOf("misregistration"), 0.9);
  expectParameter(report, "misregistration", "along_x", 2.3, 0.02);
  expectParameter(report, "misregistration", "magnification", -0.004, 0.0003);
  expectParameter(report, "misregistration", "rotation", 0.2, 0.01);
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
  EXPECT_EQ(report.causes.front().form, "any_shape");
  double sum = 0.0;
  for (const msi::GapParameter& share : report.causes.front().parameters)
  {
    sum += share.value;
  }
  // Half of the tail is nearer than 9 pixels, where blur and the first spline act.
  EXPECT_NEAR(sum, 0.2, 0.04);
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_GT(report.gap.shrink, 0.9);
}

TEST(FieldGap, RotationOfEachChannel)
{
  const GapReport report = diagnose(
    placed(TestScene(42), { { 0.5, 0.0, 0.4 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, -0.25 } }, 52));
  expectFirst(report, "misregistration", "edges");
  constexpr double Tolerance = 0.013; // 0.02 pixels at the border
  expectParameter(report, "misregistration", "rotation[C1]", 0.4, Tolerance);
  expectParameter(report, "misregistration", "rotation[C2]", 0.0, Tolerance);
  expectParameter(report, "misregistration", "rotation[C3]", -0.25, Tolerance);
  expectParameter(report, "misregistration", "along_x[C1]", 0.5, 0.02);
}

// 3 degrees move the border by five pixels: no start for a fit by gradients without a look around.
TEST(FieldGap, RotationOfTheWholeImage)
{
  const Place turned{ 0.0, 0.0, 3.0 };
  const GapReport report = diagnose(placed(TestScene(43), { turned, turned, turned }, 53));
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "misregistration");
  expectParameter(report, "misregistration", "rotation", 3.0, 0.03);
}

#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/Imaging/ImageSimulator.h"
#include "Kernels/Gap/Field/FieldCorrection.h"
#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <vector>

namespace
{
using msi::CameraEffect;
using msi::GapReport;
using msi::ImageExtent;
using msi::ImageSimulator;
using msi::ImageWindow;
using namespace msi::test;

constexpr double Planted = 0.04;

// u(x, y) + strength u(-x, -y) on a plane of pixels.
ImagePlane withGhost(const ImagePlane& plane, double strength)
{
  ImagePlane changed = plane;
  for (int y = 0; y < plane.height; ++y)
  {
    for (int x = 0; x < plane.width; ++x)
    {
      changed.at(x, y) += strength * plane.read(plane.width - 1 - x, plane.height - 1 - y);
    }
  }
  return changed;
}

TestPair ghostPair(const TestScene& scene, const std::vector<double>& strength)
{
  return makePair(
    scene,
    [&](int k)
    { return withGhost(scene.pixels(scene.fine(k)), strength[static_cast<std::size_t>(k)]); },
    51);
}

// Every reflectance 0.1 but for one bright pixel.
std::vector<float> spotScene(const ImageExtent& extent, int x, int y)
{
  const auto bands = static_cast<std::size_t>(visibleGrid().size());
  std::vector<float> reflectance(msi::wholeImage(extent).pixels() * bands, 0.1F);
  const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width) +
    static_cast<std::size_t>(x);
  for (std::size_t j = 0; j < bands; ++j)
  {
    reflectance[pixel * bands + j] = 0.9F;
  }
  return reflectance;
}

std::vector<float> simulated(const ImageExtent& extent, const std::vector<float>& reflectance,
  const std::vector<CameraEffect>& effects, const ImageWindow& window)
{
  const ImageSimulator simulator(sevenChannels(), effects, extent);
  std::vector<float> response(window.pixels() * static_cast<std::size_t>(simulator.channelCount()));
  msi::ImageWorkspace workspace;
  simulator.simulate(reflectance.data(), nullptr, msi::wholeImage(extent), window, nullptr,
    response.data(), workspace);
  return response;
}
}

TEST(GhostReflection, TheSpotAppearsOnTheOppositeSide)
{
  const ImageExtent extent{ 12, 9 };
  const std::vector<float> scene = spotScene(extent, 2, 7);
  const ImageWindow whole = msi::wholeImage(extent);
  const std::vector<float> ideal = simulated(extent, scene, {}, whole);
  const std::vector<float> ghost =
    simulated(extent, scene, { { "ghost_reflection", "common", "", { 0.05 } } }, whole);
  const Eigen::VectorXd dark = sevenChannels().dark();
  for (int y = 0; y < extent.height; ++y)
  {
    for (int x = 0; x < extent.width; ++x)
    {
      for (int k = 0; k < 7; ++k)
      {
        const auto at = [k](int column, int row)
        { return static_cast<std::size_t>((row * 12 + column) * 7 + k); };
        const double opposite = static_cast<double>(ideal[at(11 - x, 8 - y)]) - dark[k];
        EXPECT_NEAR(ghost[at(x, y)], static_cast<double>(ideal[at(x, y)]) + 0.05 * opposite, 1e-6)
          << x << " " << y << " " << k;
      }
    }
  }
}

TEST(GhostReflection, EveryPieceGivesTheSameBytes)
{
  const ImageExtent extent{ 12, 9 };
  const std::vector<float> scene = spotScene(extent, 2, 7);
  const std::vector<CameraEffect> effects = { { "ghost_reflection", "common", "", { 0.05 } } };
  const std::vector<float> whole = simulated(extent, scene, effects, msi::wholeImage(extent));
  const ImageWindow window{ 5, 1, 6, 4 };
  const std::vector<float> part = simulated(extent, scene, effects, window);
  for (int y = 0; y < window.height; ++y)
  {
    for (int i = 0; i < window.width * 7; ++i)
    {
      EXPECT_EQ(part[static_cast<std::size_t>(y * window.width * 7 + i)],
        whole[static_cast<std::size_t>(((window.y + y) * 12 + window.x) * 7 + i)]);
    }
  }
}

TEST(GhostReflection, IsFound)
{
  const TestScene scene(61);
  const GapReport report = diagnose(ghostPair(scene, { Planted, Planted, Planted }));
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "ghost_reflection");
  EXPECT_EQ(report.verdict, msi::GapVerdict::Explained);
  EXPECT_GT(report.gap.shrink, 0.85);
  EXPECT_TRUE(std::any_of(report.where.begin(), report.where.end(),
    [](const msi::GapAxis& axis) { return axis.axis == "position" && axis.share > 0.05; }));
  expectParameter(report, "ghost_reflection", "strength", Planted, 0.002);
}

TEST(GhostReflection, IsFoundChannelByChannel)
{
  const TestScene scene(62);
  const GapReport report = diagnose(ghostPair(scene, { 0.01, 0.05, 0.03 }));
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "ghost_reflection");
  expectParameter(report, "ghost_reflection", "strength[C2]", 0.05, 0.002);
}

TEST(GhostReflection, TheCorrectedImageHasIt)
{
  const TestScene scene(63, 2, 96, 80);
  const TestPair pair = makePair(
    scene, [&](int k) { return withGhost(scene.pixels(scene.fine(k)), Planted); }, 52, 0.0, 0.0);
  msi::FieldModel model(2);
  model[msi::imageParameter("ghost_reflection", "strength")].setConstant(Planted);
  std::vector<float> corrected(pair.real.size());
  msi::CorrectionWorkspace workspace;
  msi::FieldCorrection(pair.pair(), model)(
    msi::wholeImage(pair.extent), corrected.data(), workspace);
  for (std::size_t i = 0; i < corrected.size(); ++i)
  {
    ASSERT_NEAR(corrected[i], pair.real[i], 1e-5) << i;
  }
}

#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/SampleScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using msi::test::messageOf;
using msi::test::rasterSamples;
using msi::test::visibleGrid;

msi::SampleScene sceneOf(const msi::SceneSamples& samples)
{
  return { visibleGrid(), samples };
}

TEST(SampleScene, NumbersMediaAndScenesInOrderOfAppearance)
{
  const msi::SampleScene scene = sceneOf(rasterSamples());
  EXPECT_EQ(scene.media(), (std::vector<std::string>{ "paper", "fabric" }));
  EXPECT_EQ(scene.scenes(), (std::vector<std::string>{ "a", "b" }));
  EXPECT_EQ(scene.medium()[3], 1);
  EXPECT_EQ(scene.scene()[12], 1);
}

TEST(SampleScene, FieldIsCenteredAndKeepsCirclesRound)
{
  // 8 columns and 6 rows, 10 units apart: half the longer side is 35.
  const msi::SampleScene scene = sceneOf(rasterSamples());
  EXPECT_DOUBLE_EQ(scene.fieldX()[0], -1.0);
  EXPECT_DOUBLE_EQ(scene.fieldX()[7], 1.0);
  EXPECT_DOUBLE_EQ(scene.fieldY()[0], -25.0 / 35.0);
  EXPECT_DOUBLE_EQ(scene.fieldY()[47], 25.0 / 35.0);
  EXPECT_DOUBLE_EQ(scene.time()[0], 0.0);
  EXPECT_DOUBLE_EQ(scene.time()[47], 1.0);
}

TEST(SampleScene, NeighboursAreTheEightAroundWithinTheScene)
{
  const msi::SampleScene scene = sceneOf(rasterSamples());
  EXPECT_EQ(scene.neighbours()[9], (std::vector<int>{ 0, 1, 2, 8, 10, 16, 17, 18 }));
  EXPECT_EQ(scene.neighbours()[0], (std::vector<int>{ 1, 8, 9 }));
  // Column 3 is the last of scene a.
  EXPECT_EQ(scene.neighbours()[11], (std::vector<int>{ 2, 3, 10, 18, 19 }));
}

TEST(SampleScene, NamesTheColumnThatDoesNotFit)
{
  msi::SceneSamples samples = rasterSamples();
  samples.order.conservativeResize(47);
  EXPECT_EQ(
    messageOf([&] { sceneOf(samples); }), "the scene has 48 samples but 47 values of order");
  samples = rasterSamples();
  samples.y.resize(0);
  EXPECT_EQ(messageOf([&] { sceneOf(samples); }),
    "the scene has only one of x and y; a position needs both");
  samples = rasterSamples();
  samples.x[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
    messageOf([&] { sceneOf(samples); }), "the x of sample 5 is nan; expected a finite number");
  samples = rasterSamples();
  samples.reflectance.conservativeResize(30, 48);
  EXPECT_EQ(messageOf([&] { sceneOf(samples); }),
    "the scene's reflectances have 30 wavelengths, their grid 31");
}

TEST(SampleScene, WorksWithoutMetadata)
{
  msi::SceneSamples samples;
  samples.reflectance = Eigen::MatrixXd::Constant(31, 3, 0.5);
  const msi::SampleScene scene = sceneOf(samples);
  EXPECT_FALSE(scene.hasPositions());
  EXPECT_FALSE(scene.hasOrder());
  EXPECT_EQ(scene.media().size(), 1U);
  EXPECT_EQ(scene.medium(), (std::vector<int>{ 0, 0, 0 }));
}

}

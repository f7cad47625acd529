#include "Kernels/Scenes/Colorants.h"
#include "Kernels/Scenes/KubelkaMunk.h"
#include "Kernels/Scenes/Measuring.h"
#include "Kernels/Scenes/PatchLayout.h"
#include "Kernels/Scenes/Samples.h"
#include "Kernels/Scenes/WovenFabric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
namespace scenes = msi::scenes;

TEST(KubelkaMunk, ReflectanceAndAbsorptionAreInverse)
{
  const Eigen::ArrayXd reflectance = Eigen::ArrayXd::LinSpaced(50, 0.01, 0.99);
  const Eigen::ArrayXd back = scenes::opaqueReflectance(scenes::absorptionOf(reflectance));
  EXPECT_LT((back - reflectance).abs().maxCoeff(), 1e-13);
  // K/S = 1/4 gives exactly one half.
  EXPECT_NEAR(scenes::opaqueReflectance(Eigen::ArrayXd::Constant(1, 0.25))[0], 0.5, 1e-15);
}

TEST(KubelkaMunk, SaundersonKeepsALosslessBodyWhite)
{
  const Eigen::ArrayXd white = Eigen::ArrayXd::Ones(1);
  EXPECT_NEAR(scenes::throughSurface(white, 0.04, 0.6, 1.0)[0], 1.0, 1e-15);
  EXPECT_NEAR(scenes::throughSurface(Eigen::ArrayXd::Zero(1), 0.04, 0.6, 1.0)[0], 0.04, 1e-15);
}

TEST(AbsorptionBand, HasItsHeightAtTheCenterAndItsWidthBesideIt)
{
  const scenes::Colorant dye{ "dye", { { 2.0, 550.0, 30.0, 12.0 } }, 0.5 };
  const Eigen::ArrayXd k = scenes::absorption(dye, msi::WavelengthGrid({ 520.0, 550.0, 562.0 }));
  EXPECT_NEAR(k[1], 2.5, 1e-14);
  // One standard deviation in wavenumber lies near 520.3 and 562.3 nm.
  EXPECT_NEAR(k[0], 0.5 + 2.0 * std::exp(-0.5), 0.08);
  EXPECT_NEAR(k[2], 0.5 + 2.0 * std::exp(-0.5), 0.06);
}

TEST(Samples, ArePossibleReflectancesAndAllDifferent)
{
  const msi::WavelengthGrid grid = scenes::sceneGrid();
  for (const scenes::Swatches& set : { scenes::printedChart(grid, 24, 1),
         scenes::printedChart(grid, 140, 1), scenes::dyedFabric(grid, 60, 1) })
  {
    EXPECT_GT(set.body.minCoeff(), 0.0);
    EXPECT_LT(set.body.maxCoeff(), 1.0);
    EXPECT_EQ(static_cast<Eigen::Index>(set.name.size()), set.body.cols());
    EXPECT_EQ(std::set<std::string>(set.name.begin(), set.name.end()).size(), set.name.size());
    for (Eigen::Index a = 0; a < set.body.cols(); ++a)
    {
      for (Eigen::Index b = 0; b < a; ++b)
      {
        EXPECT_GT((set.body.col(a) - set.body.col(b)).norm(), 0.0) << a << " " << b;
      }
    }
  }
  EXPECT_THROW(scenes::printedChart(grid, 25, 1), std::invalid_argument);
  EXPECT_THROW(scenes::dyedCotton(grid, "no such dye", 1.0), std::invalid_argument);
}

TEST(Samples, DependOnTheSeedAlone)
{
  const msi::WavelengthGrid grid = scenes::sceneGrid();
  EXPECT_EQ(scenes::dyedFabric(grid, 20, 3).body, scenes::dyedFabric(grid, 20, 3).body);
  EXPECT_NE(scenes::dyedFabric(grid, 20, 3).body, scenes::dyedFabric(grid, 20, 4).body);
}

TEST(WovenFabric, MeanLightAndCavityAreThoseOfTheWeave)
{
  const scenes::Weave weave;
  double shade = 0.0;
  double cavity = 0.0;
  constexpr int Side = 400;
  for (int y = 0; y < Side; ++y)
  {
    for (int x = 0; x < Side; ++x)
    {
      const scenes::WeavePoint point = scenes::weavePoint(weave, x, y, 8);
      shade += point.shade;
      cavity += point.cavity;
    }
  }
  // 93 yarns each way with a spread of 2.5 %; pixels sample the yarn's back to about 2 %.
  EXPECT_NEAR(shade / (Side * Side), weave.meanShade, 0.02);
  EXPECT_NEAR(cavity / (Side * Side), weave.meanCavity, 0.02);
}

TEST(WovenFabric, SeenThroughIsTheSumOfAllReflections)
{
  const scenes::WeavePoint point{ 0.8, 0.3, true, 0 };
  const double body = 0.6;
  double sum = 0.0;
  double onTheWay = point.shade * body;
  for (int bounce = 0; bounce < 60; ++bounce)
  {
    sum += onTheWay * (1.0 - point.cavity);
    onTheWay *= point.cavity * body;
  }
  EXPECT_NEAR(scenes::seenThrough(point, Eigen::ArrayXd::Constant(1, body))[0], sum, 1e-14);
}

TEST(Measuring, TwoSamplesOfEqualReadingDifferForTheCamera)
{
  // Cross-media metamerism: the same reflectance on paper and as fabric.
  const Eigen::MatrixXd fabric = Eigen::MatrixXd::Constant(scenes::sceneGrid().size(), 1, 0.40);
  const double reading = scenes::measuredFabric(fabric, 1).mean();
  const auto paperReading = [](double body)
  { return scenes::throughSurface(Eigen::ArrayXd::Constant(1, body), 0.04, 0.45, 1.0)[0]; };
  double low = 0.0;
  double high = 1.0;
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (low + high);
    (paperReading(middle) < reading ? low : high) = middle;
  }
  const Eigen::MatrixXd paper = Eigen::MatrixXd::Constant(scenes::sceneGrid().size(), 1, low);
  EXPECT_NEAR(scenes::measuredPaper(paper, 1).mean(), reading, 1e-3);
  EXPECT_GT(scenes::seenPaper(paper, 1).mean() - scenes::seenFabric(fabric, 1).mean(), 0.02);
}

TEST(PatchLayout, PutsEveryPatchIntoThePicture)
{
  for (const int count : { 24, 140 })
  {
    const scenes::PatchLayout layout = scenes::chartLayout(count);
    const scenes::LabelImage labels = layout.labels(1);
    std::set<int> seen(labels.data(), labels.data() + labels.size());
    EXPECT_EQ(static_cast<int>(seen.size()), count + 1);
    EXPECT_EQ(*seen.rbegin(), count);
    EXPECT_EQ(labels(0, 0), 0);
    EXPECT_EQ(labels(layout.height - 1, layout.width - 1), 0);
  }
  EXPECT_THROW(scenes::chartLayout(25), std::invalid_argument);
}

TEST(PatchLayout, LabelsStayInsideThePatches)
{
  constexpr scenes::PatchLayout Layout{ 6, 4, 6, 13, 42, 34, 38, 256, 192 };
  const scenes::LabelImage labels = Layout.labels(2);
  EXPECT_EQ(labels.rows(), 192);
  EXPECT_EQ(labels.cols(), 256);
  for (int patch = 1; patch <= 24; ++patch)
  {
    EXPECT_EQ((labels == static_cast<std::uint8_t>(patch)).count(), 30 * 34) << patch;
  }
}

}

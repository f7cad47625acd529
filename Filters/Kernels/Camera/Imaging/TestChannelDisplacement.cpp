#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/Imaging/ChannelDisplacement.h"
#include "Kernels/Camera/Imaging/DisplacedChart.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
using msi::ChannelDisplacement;
using msi::DisplacementModel;
using msi::DisplacementSearch;
using msi::PixelBuffer;
using msi::test::DisplacedChart;
using msi::test::messageOf;

constexpr int ReferenceChannel = 2;
const std::vector<ChannelDisplacement> Shifts{ { 1.37, -0.62 }, { -2.45, 0.18 }, {}, { 0.5, 0.5 },
  { 7.3, -5.9 } };
const std::vector<ChannelDisplacement> Similarities{ { 1.37, -0.62, 1.5e-3, 0.11 },
  { -2.45, 0.18, -0.8e-3, -0.23 }, {}, { 0.25, 0.75, 0.0, 0.07 }, { 4.1, -3.3, 2.2e-3, 0.0 } };

std::vector<PixelBuffer> tilesOf(const DisplacedChart& chart)
{
  std::vector<PixelBuffer> tiles;
  for (const msi::ImageWindow& window : msi::displacementTiles(chart.extent))
  {
    tiles.push_back(chart.pixels(window));
  }
  return tiles;
}

// The largest error anywhere in the image that wrong numbers lead to, in pixels.
double placeError(const ChannelDisplacement& found, const ChannelDisplacement& truth,
  const msi::ImageExtent& extent)
{
  const double corner = 0.5 * std::hypot(extent.width, extent.height);
  return std::hypot(found.right - truth.right, found.down - truth.down) +
    corner *
    std::hypot(found.magnification - truth.magnification,
      (found.rotation - truth.rotation) * std::acos(-1.0) / 180.0);
}

TEST(ChannelDisplacement, FindsShiftsBelowAPixelWhateverTheContrasts)
{
  // Contrasts of the patches are drawn for every channel: half of the edges are reversed.
  const DisplacedChart chart{ { 260, 190 }, Shifts };
  const auto tiles = tilesOf(chart);
  const DisplacementSearch search(tiles, chart.extent, DisplacementModel::Shift);
  for (int k = 0; k < 5; ++k)
  {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_LT(placeError(search(ReferenceChannel, k), Shifts[i], chart.extent), 0.015)
      << "channel " << k;
  }
}

TEST(ChannelDisplacement, FindsMagnificationAndRotationInTilesOfALargeImage)
{
  const DisplacedChart chart{ { 900, 700 }, Similarities };
  const auto tiles = tilesOf(chart);
  ASSERT_EQ(tiles.size(), 16U);
  const DisplacementSearch search(tiles, chart.extent, DisplacementModel::Similarity);
  for (int k = 0; k < 5; ++k)
  {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_LT(placeError(search(ReferenceChannel, k), Similarities[i], chart.extent), 0.03)
      << "channel " << k;
  }
}

TEST(ChannelDisplacement, StandardErrorsAreTheSpreadOverNoisyImages)
{
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    const DisplacedChart chart{ { 200, 160 }, { { 0.7, -0.4 }, {} }, 0.02, seed };
    const auto tiles = tilesOf(chart);
    const ChannelDisplacement found =
      DisplacementSearch(tiles, chart.extent, DisplacementModel::Shift)(1, 0);
    for (const double z :
      { (found.right - 0.7) / found.standardError[0], (found.down + 0.4) / found.standardError[1] })
    {
      sum += z * z;
      ++count;
    }
  }
  const double ratio = std::sqrt(sum / count);
  EXPECT_GT(ratio, 0.6);
  EXPECT_LT(ratio, 1.6);
}

TEST(ChannelDisplacement, RegistrationPutsTheChannelsBack)
{
  const DisplacedChart chart{ { 200, 170 }, Similarities };
  DisplacedChart straight = chart;
  straight.displacements.assign(Similarities.size(), {});
  const PixelBuffer expected = straight.pixels(msi::wholeImage(chart.extent));
  PixelBuffer registered = chart.pixels(msi::wholeImage(chart.extent));
  double before = 0.0;
  for (std::size_t i = 0; i < expected.values.size(); ++i)
  {
    before =
      std::max(before, std::abs(static_cast<double>(registered.values[i] - expected.values[i])));
  }
  PixelBuffer scratch;
  msi::undoing(Similarities, chart.extent)(registered, scratch);
  double after = 0.0;
  int shown = 0;
  for (int y = 0; y < chart.extent.height; ++y)
  {
    for (int x = 0; x < chart.extent.width; ++x)
    {
      for (std::size_t k = 0; k < Similarities.size(); ++k)
      {
        if (msi::ShownPixels(Similarities[k], chart.extent).contain(x, y))
        {
          ++shown;
          // Cubic convolution reads two pixels to each side, which the edge cuts.
          const bool isInside =
            x > 9 && y > 9 && x < chart.extent.width - 10 && y < chart.extent.height - 10;
          const double error = std::abs(static_cast<double>(registered.pixel(x, y)[k]) -
            static_cast<double>(expected.pixel(x, y)[k]));
          after = isInside ? std::max(after, error) : after;
        }
      }
    }
  }
  EXPECT_GT(before, 0.3);
  EXPECT_LT(after, 0.02);
  EXPECT_GT(shown, 0.94 * static_cast<double>(expected.values.size()));
  EXPECT_LT(shown, static_cast<int>(expected.values.size()));
}

TEST(ChannelDisplacement, SaysWhereTheImageDoesNotTell)
{
  DisplacedChart chart{ { 120, 100 }, { { 0.4, 0.2 }, {} } };
  auto tiles = tilesOf(chart);
  for (std::size_t i = 0; i < tiles[0].values.size(); i += 2)
  {
    tiles[0].values[i] = 0.5F; // the first channel shows nothing
  }
  const DisplacementSearch search(tiles, chart.extent, DisplacementModel::Shift);
  EXPECT_FALSE(std::isfinite(search(1, 0).standardError[0]));
  EXPECT_GT(msi::structureOf(tiles, 1), msi::structureOf(tiles, 0));
}

TEST(ChannelDisplacement, WindowsWithNaNTakeNoPart)
{
  const DisplacedChart chart{ { 260, 190 }, Shifts };
  auto tiles = tilesOf(chart);
  for (int x = 90; x < 130; ++x)
  {
    tiles[0].pixel(x, 70)[0] = std::numeric_limits<float>::quiet_NaN();
  }
  const DisplacementSearch search(tiles, chart.extent, DisplacementModel::Shift);
  EXPECT_LT(placeError(search(ReferenceChannel, 0), Shifts[0], chart.extent), 0.02);
}

TEST(ChannelDisplacement, ComposesAsThePlacesDo)
{
  const msi::ImageExtent extent{ 300, 200 };
  const ChannelDisplacement first{ 1.5, -0.5, 2e-3, 0.4, { 0.03, 0.0, 0.0, 0.0 }, 0.9 };
  const ChannelDisplacement second{ -2.0, 1.0, -1e-3, -1.1, { 0.04, 0.0, 0.0, 0.0 }, 0.7 };
  const ChannelDisplacement both = msi::composed(first, second);
  const auto placeOf = [&](const ChannelDisplacement& d, const Eigen::Vector2d& from)
  {
    const Eigen::Vector2d middle(0.5 * (extent.width - 1), 0.5 * (extent.height - 1));
    const Eigen::Rotation2Dd turn(d.rotation * std::acos(-1.0) / 180.0);
    return Eigen::Vector2d(middle + (1.0 + d.magnification) * (turn * (from - middle)) +
      Eigen::Vector2d(d.right, d.down));
  };
  for (const Eigen::Vector2d& from : { Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(250.0, 40.0) })
  {
    EXPECT_LT((placeOf(both, from) - placeOf(second, placeOf(first, from))).norm(), 1e-9);
  }
  EXPECT_NEAR(both.standardError[0], 0.05, 1e-15);
  EXPECT_EQ(both.agreement, 0.7);
}

TEST(ChannelDisplacement, RefusesBadInputAndSaysWhy)
{
  const DisplacedChart chart{ { 60, 30 }, { {}, {} } };
  const auto tiles = tilesOf(chart);
  EXPECT_EQ(messageOf([&] { DisplacementSearch(tiles, chart.extent, DisplacementModel::Shift); }),
    "the image is 60 x 30 pixels; expected at least 32 on each side to find the channels' "
    "displacements");
  const std::vector<PixelBuffer> none;
  EXPECT_EQ(messageOf([&] { DisplacementSearch(none, chart.extent, DisplacementModel::Shift); }),
    "there is no tile of the image; expected at least 1");
}

}

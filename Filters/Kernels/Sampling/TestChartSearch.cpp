#include "Kernels/Sampling/ChartSearch.h"
#include "Kernels/Sampling/EvenRegions.h"
#include "Kernels/Sampling/Homography.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{

using Corners = msi::PatchGrid::Corners;

// A chart as a camera sees it: patches with gaps on a dark frame, before a dotted wall.
struct Scene
{
  int columns = 6;
  int rows = 4;
  int width = 480;
  int height = 360;
  Corners corners;     // of the cells: gaps are half inside
  double gap = 0.15;   // of a cell
  double noise = 0.01; // relative to white
  unsigned seed = 1;
  Eigen::MatrixXd patches; // channels x patches
  Eigen::MatrixXf pixels;  // channels x pixels
  Eigen::Matrix3d toImage;
};

Eigen::MatrixXd randomPatches(int channels, int patches, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> level(std::log(0.04), std::log(0.9));
  std::uniform_real_distribution<double> tint(-0.6, 0.6);
  Eigen::MatrixXd values(channels, patches);
  for (Eigen::Index i = 0; i < values.cols(); ++i)
  {
    const double gray = level(random);
    for (Eigen::Index k = 0; k < values.rows(); ++k)
    {
      values(k, i) = std::min(0.95, std::exp(gray + tint(random)));
    }
  }
  return values;
}

void draw(Scene& scene)
{
  constexpr int Channels = 3;
  scene.patches = randomPatches(Channels, scene.columns * scene.rows, scene.seed);
  const double c = scene.columns;
  const double r = scene.rows;
  scene.toImage = msi::fitHomography(
    { { 0, 0 }, { c, 0 }, { c, r }, { 0, r } }, { scene.corners.begin(), scene.corners.end() });
  const Eigen::Matrix3d toChart = scene.toImage.inverse();
  scene.pixels.resize(Channels, static_cast<Eigen::Index>(scene.width) * scene.height);
  std::mt19937 random(scene.seed + 100);
  std::normal_distribution<double> noise(0.0, scene.noise);
  for (int y = 0; y < scene.height; ++y)
  {
    for (int x = 0; x < scene.width; ++x)
    {
      const auto at = msi::mapPoint(toChart, { x, y });
      const double margin = 0.3;
      const bool onChart =
        at.x() > -margin && at.y() > -margin && at.x() < c + margin && at.y() < r + margin;
      Eigen::VectorXd value = Eigen::VectorXd::Constant(
        Channels, x % 9 < 3 && y % 9 < 3 ? 0.25 : 0.7 - 0.2 * x / scene.width);
      if (onChart)
      {
        value.setConstant(0.06);
        const double column = std::floor(at.x());
        const double row = std::floor(at.y());
        const double half = 0.5 - 0.5 * scene.gap;
        if (column >= 0 && row >= 0 && column < c && row < r &&
          std::abs(at.x() - column - 0.5) < half && std::abs(at.y() - row - 0.5) < half)
        {
          value = scene.patches.col(
            static_cast<Eigen::Index>(column) + scene.columns * static_cast<Eigen::Index>(row));
        }
      }
      // Light that falls off to one side, and shot noise.
      value *= 0.8 + 0.2 * y / scene.height;
      for (Eigen::Index k = 0; k < Channels; ++k)
      {
        scene.pixels(k, static_cast<Eigen::Index>(y) * scene.width + x) =
          static_cast<float>(value[k] + noise(random) * std::sqrt(value[k]));
      }
    }
  }
}

Corners turned(double degrees, double width, double height, const Eigen::Vector2d& center,
  double perspective = 0.0)
{
  const double angle = degrees * std::acos(-1.0) / 180.0;
  Eigen::Matrix2d rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  Corners corners{ { { -width / 2, -height / 2 }, { width / 2, -height / 2 },
    { width / 2, height / 2 }, { -width / 2, height / 2 } } };
  for (auto& corner : corners)
  {
    const double depth =
      1.0 + perspective * corner.x() / width + 0.5 * perspective * corner.y() / height;
    corner = center + rotation * (corner / depth);
  }
  return corners;
}

// How many patch middles get their own number.
int rightLabels(const Scene& scene, const Corners& corners)
{
  const msi::PatchGrid grid(scene.columns, scene.rows, corners, 0.5);
  int right = 0;
  for (int row = 0; row < scene.rows; ++row)
  {
    for (int column = 0; column < scene.columns; ++column)
    {
      const auto at = msi::mapPoint(scene.toImage, { column + 0.5, row + 0.5 });
      right += grid.labelAt(at.x(), at.y()) == 1 + column + scene.columns * row ? 1 : 0;
    }
  }
  return right;
}

msi::ChartPlacement find(const Scene& scene, bool withColors = true)
{
  msi::ChartSearchOptions options;
  options.columns = scene.columns;
  options.rows = scene.rows;
  if (withColors)
  {
    options.expected = 2.0 * scene.patches; // up to a factor
  }
  return msi::findChart(msi::makeChartImage(scene.pixels, scene.width, scene.height), options);
}

TEST(ChartSearch, FindsATurnedChart)
{
  for (const double degrees : { 0.0, 12.0, 45.0, 90.0, 133.0, 180.0, 271.0 })
  {
    Scene scene;
    scene.corners = turned(degrees, 270, 180, { 240, 180 });
    draw(scene);
    const auto placement = find(scene);
    EXPECT_EQ(rightLabels(scene, placement.corners), 24) << degrees << " degrees";
    EXPECT_GT(placement.agreement, 0.95) << degrees;
    EXPECT_GT(placement.agreement, placement.secondAgreement + 0.2) << degrees;
  }
}

TEST(ChartSearch, FindsItInPerspective)
{
  for (const double perspective : { -0.4, 0.2, 0.5 })
  {
    Scene scene;
    scene.corners = turned(20.0, 260, 180, { 230, 210 }, perspective);
    draw(scene);
    const auto placement = find(scene);
    EXPECT_EQ(rightLabels(scene, placement.corners), 24) << perspective;
    // Cells reach to the middle of the gaps: the corners are those that were drawn. The middle of an area is not quite
    // the picture of its middle, so that the outer cells are a few percent off.
    const Eigen::Matrix3d toChart = scene.toImage.inverse();
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Eigen::Vector2d off =
        msi::mapPoint(toChart, placement.corners[i]) - msi::mapPoint(toChart, scene.corners[i]);
      EXPECT_LT(off.norm(), 0.1) << perspective << " " << i;
    }
  }
}

TEST(ChartSearch, FindsOtherGrids)
{
  struct Grid
  {
    int columns;
    int rows;
  };
  for (const auto& grid :
    { Grid{ 14, 10 }, Grid{ 5, 7 }, Grid{ 4, 4 }, Grid{ 10, 10 }, Grid{ 12, 8 } })
  {
    Scene scene;
    scene.columns = grid.columns;
    scene.rows = grid.rows;
    scene.width = 700;
    scene.height = 520;
    scene.seed = 7;
    const double cell = 400.0 / std::max(grid.columns, grid.rows);
    scene.corners = turned(188.0, cell * grid.columns, cell * grid.rows, { 340, 260 }, 0.15);
    draw(scene);
    const auto placement = find(scene);
    EXPECT_EQ(rightLabels(scene, placement.corners), grid.columns * grid.rows)
      << grid.columns << " x " << grid.rows;
  }
}

// Patches of a row as dark as the frame are not seen; the others and the colors tell where they are.
TEST(ChartSearch, FindsPatchesThatLookLikeTheFrame)
{
  Scene scene;
  scene.corners = turned(-8.0, 270, 180, { 240, 180 });
  draw(scene);
  const Eigen::MatrixXd patches = scene.patches;
  // The last row, as dark as the frame.
  const Eigen::Matrix3d toChart = scene.toImage.inverse();
  for (int y = 0; y < scene.height; ++y)
  {
    for (int x = 0; x < scene.width; ++x)
    {
      const auto at = msi::mapPoint(toChart, { x, y });
      if (at.x() > 0 && at.x() < 6 && at.y() > 3 && at.y() < 4)
      {
        scene.pixels.col(static_cast<Eigen::Index>(y) * scene.width + x).setConstant(0.05F);
      }
    }
  }
  scene.patches.rightCols(6).setConstant(0.05);
  const auto placement = find(scene);
  EXPECT_EQ(rightLabels(scene, placement.corners), 24);
  EXPECT_LE(placement.seen, 18);
}

TEST(ChartSearch, WithoutColorsTheChartStandsUpright)
{
  Scene scene;
  scene.corners = turned(15.0, 270, 180, { 240, 180 });
  draw(scene);
  const auto placement = find(scene, false);
  EXPECT_EQ(rightLabels(scene, placement.corners), 24);
  EXPECT_TRUE(std::isnan(placement.agreement));
}

TEST(ChartSearch, LargeImagesAreReduced)
{
  Scene scene;
  scene.width = 1500;
  scene.height = 1100;
  scene.corners = turned(33.0, 800, 540, { 760, 540 }, 0.2);
  draw(scene);
  EXPECT_EQ(msi::makeChartImage(scene.pixels, scene.width, scene.height).reduction, 3);
  EXPECT_EQ(rightLabels(scene, find(scene).corners), 24);
}

std::string errorOf(const Scene& scene, const msi::ChartSearchOptions& options)
{
  try
  {
    msi::findChart(msi::makeChartImage(scene.pixels, scene.width, scene.height), options);
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return {};
}

TEST(ChartSearch, SaysWhatItDidNotFind)
{
  Scene scene;
  scene.corners = turned(0.0, 270, 180, { 240, 180 });
  draw(scene);
  msi::ChartSearchOptions options;
  options.columns = 14;
  options.rows = 10;
  EXPECT_NE(
    errorOf(scene, options).find("no chart of 14 x 10 patches was found"), std::string::npos);

  options.columns = 6;
  options.rows = 4;
  options.expected = randomPatches(3, 24, 99); // another chart
  EXPECT_NE(errorOf(scene, options).find("its colors do not agree"), std::string::npos);

  options.expected = randomPatches(2, 24, 1);
  EXPECT_NE(errorOf(scene, options).find("in 2 channels"), std::string::npos);
  options.columns = 1;
  EXPECT_NE(errorOf(scene, options).find("expected at least 2 x 2"), std::string::npos);
}

TEST(ChartImage, RefusesWhatIsNoImage)
{
  EXPECT_THROW(msi::makeChartImage(Eigen::MatrixXf::Ones(2, 11), 4, 3), std::invalid_argument);
  EXPECT_THROW(msi::makeChartImage(Eigen::MatrixXf::Zero(2, 12), 4, 3), std::invalid_argument);
}

// NaN pixels belong to no region, and their neighbours stay what they are.
TEST(EvenRegions, LeaveNaNAlone)
{
  Eigen::MatrixXf pixels = Eigen::MatrixXf::Constant(1, 60 * 40, 0.1F);
  for (int y = 10; y < 30; ++y)
  {
    for (int x = 10; x < 30; ++x)
    {
      pixels(0, y * 60 + x) = 0.8F;
    }
  }
  pixels(0, 5 * 60 + 50) = std::nanf("");
  const auto regions = msi::findEvenRegions(msi::makeChartImage(pixels, 60, 40));
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_NEAR(regions[0].center.x(), 19.5, 0.1);
  EXPECT_NEAR(regions[0].center.y(), 19.5, 0.1);
}

// Four points fix a homography; a fifth that follows it changes nothing.
TEST(Homography, ReturnsTheMapThatMadeThePoints)
{
  Eigen::Matrix3d map;
  map << 1.2, 0.1, 30.0, -0.2, 0.9, 12.0, 1e-3, -2e-3, 1.0;
  const std::vector<Eigen::Vector2d> from{ { 0, 0 }, { 100, 3 }, { 95, 80 }, { -4, 70 },
    { 40, 30 } };
  std::vector<Eigen::Vector2d> to;
  for (const auto& point : from)
  {
    to.push_back(msi::mapPoint(map, point));
  }
  EXPECT_LT((msi::fitHomography(from, to) - map).norm(), 1e-6);
  EXPECT_THROW(
    msi::fitHomography({ from.begin(), from.begin() + 3 }, { to.begin(), to.begin() + 3 }),
    std::invalid_argument);
  EXPECT_THROW(msi::fitHomography({ { 0, 0 }, { 1, 1 }, { 2, 2 }, { 3, 3 } },
                 { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 3, 3 } }),
    std::invalid_argument);
}

}

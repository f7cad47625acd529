#include "Kernels/Sampling/PatchGrid.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

const msi::PatchGrid::Corners Upright = { { { 0, 0 }, { 60, 0 }, { 60, 40 }, { 0, 40 } } };

TEST(PatchGrid, NumbersPatchesAlongRows)
{
  const msi::PatchGrid grid(6, 4, Upright, 0.5);
  EXPECT_EQ(grid.patches(), 24);
  EXPECT_EQ(grid.labelAt(5, 5), 1);
  EXPECT_EQ(grid.labelAt(15, 5), 2);
  EXPECT_EQ(grid.labelAt(5, 15), 7);
  EXPECT_EQ(grid.labelAt(55, 35), 24);
}

TEST(PatchGrid, BordersAndOutsideAreNoPatch)
{
  const msi::PatchGrid grid(6, 4, Upright, 0.5);
  EXPECT_EQ(grid.labelAt(10, 5), 0);  // on the line between two cells
  EXPECT_EQ(grid.labelAt(2.4, 5), 0); // just outside the middle half
  EXPECT_EQ(grid.labelAt(2.6, 5), 1); // just inside
  EXPECT_EQ(grid.labelAt(-5, 5), 0);
  EXPECT_EQ(grid.labelAt(65, 5), 0);
  EXPECT_EQ(grid.labelAt(std::numeric_limits<double>::quiet_NaN(), 5), 0);
}

// A plane seen by a pinhole: x' = x / (1 + x / 100), y' = y / (1 + x / 100) keeps lines straight, so the
// middle of each cell must land in its patch.
TEST(PatchGrid, FollowsPerspective)
{
  const auto seen = [](double x, double y)
  { return Eigen::Vector2d(x / (1 + x / 100), y / (1 + x / 100)); };
  const msi::PatchGrid grid(6, 4, { { seen(0, 0), seen(60, 0), seen(60, 40), seen(0, 40) } }, 0.2);
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 6; ++column)
    {
      const auto p = seen(10 * column + 5, 10 * row + 5);
      EXPECT_EQ(grid.labelAt(p.x(), p.y()), 1 + column + 6 * row);
    }
  }
}

TEST(PatchGrid, MirroredCornersCountTheOtherWay)
{
  const msi::PatchGrid grid(6, 4, { { { 60, 0 }, { 0, 0 }, { 0, 40 }, { 60, 40 } } }, 0.5);
  EXPECT_EQ(grid.labelAt(55, 5), 1);
  EXPECT_EQ(grid.labelAt(5, 5), 6);
}

std::string messageOf(
  int columns, int rows, const msi::PatchGrid::Corners& corners, double fraction)
{
  try
  {
    msi::PatchGrid grid(columns, rows, corners, fraction);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

TEST(PatchGrid, RefusesWhatIsNoChart)
{
  EXPECT_EQ(
    messageOf(0, 4, Upright, 0.5), "a chart of 0 x 4 patches; expected 1 to 1000 columns and rows");
  EXPECT_NE(
    messageOf(6, 4, Upright, 0.0).find("expected more than 0, at most 1"), std::string::npos);
  // Two corners exchanged: a bow tie.
  const auto bowTie = messageOf(6, 4, { { { 0, 0 }, { 60, 40 }, { 60, 0 }, { 0, 40 } } }, 0.5);
  EXPECT_NE(bowTie.find("span no convex quadrilateral"), std::string::npos);
  EXPECT_NE(messageOf(6, 4, { { { 0, 0 }, { 30, 0 }, { 60, 0 }, { 0, 40 } } }, 0.5), "");
}

}

#include "Kernels/Sampling/PatchGrid.h"

#include <Eigen/LU>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr int LargestGrid = 1000;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

void requireConvex(const PatchGrid::Corners& corners)
{
  int turns = 0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    if (!corners[i].allFinite())
    {
      throw std::invalid_argument(
        "corner " + std::to_string(i + 1) + " of the chart is not finite");
    }
    const double turn = cross(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]);
    turns += turn > 0.0 ? 1 : (turn < 0.0 ? -1 : 0);
  }
  if (std::abs(turns) != 4)
  {
    std::ostringstream message;
    message << "the corners";
    for (const auto& corner : corners)
    {
      message << " (" << corner.x() << ", " << corner.y() << ')';
    }
    message
      << " span no convex quadrilateral; give the outer corners of the chart in the order first "
         "patch, end of the first row, last patch, start of the last row";
    throw std::invalid_argument(message.str());
  }
}

void requireFraction(double fraction)
{
  if (!(fraction > 0.0 && fraction <= 1.0))
  {
    throw std::invalid_argument(
      "the patch fraction is " + std::to_string(fraction) + "; expected more than 0, at most 1");
  }
}

// Heckbert's square-to-quadrilateral map: the unit square's (0,0), (1,0), (1,1), (0,1) to the corners.
Eigen::Matrix3d squareToCorners(const PatchGrid::Corners& c)
{
  const Eigen::Vector2d d1 = c[1] - c[2];
  const Eigen::Vector2d d2 = c[3] - c[2];
  const Eigen::Vector2d s = c[0] - c[1] + c[2] - c[3];
  const double determinant = d1.x() * d2.y() - d2.x() * d1.y();
  const double g = (s.x() * d2.y() - d2.x() * s.y()) / determinant;
  const double h = (d1.x() * s.y() - s.x() * d1.y()) / determinant;
  Eigen::Matrix3d map;
  map.col(0) << c[1] - c[0] + g * c[1], g;
  map.col(1) << c[3] - c[0] + h * c[3], h;
  map.col(2) << c[0], 1.0;
  return map;
}
}

PatchGrid::PatchGrid(int columns, int rows, const Corners& corners, double fraction)
  : Columns(columns)
  , Rows(rows)
  , Fraction(fraction)
{
  if (columns < 1 || rows < 1 || columns > LargestGrid || rows > LargestGrid)
  {
    throw std::invalid_argument("a chart of " + std::to_string(columns) + " x " +
      std::to_string(rows) + " patches; expected 1 to 1000 columns and rows");
  }
  requireFraction(fraction);
  requireConvex(corners);
  const Eigen::Vector3d cells(columns, rows, 1.0);
  ToChart = cells.asDiagonal() * squareToCorners(corners).inverse();
}

PatchGrid PatchGrid::withFraction(double fraction) const
{
  requireFraction(fraction);
  PatchGrid other(*this);
  other.Fraction = fraction;
  return other;
}

int PatchGrid::labelAt(double x, double y) const noexcept
{
  const Eigen::Vector3d p = ToChart * Eigen::Vector3d(x, y, 1.0);
  const double column = p.x() / p.z();
  const double row = p.y() / p.z();
  if (!(column >= 0.0 && row >= 0.0 && column < Columns && row < Rows))
  {
    return 0;
  }
  const double half = 0.5 * Fraction;
  if (std::abs(column - std::floor(column) - 0.5) > half ||
    std::abs(row - std::floor(row) - 0.5) > half)
  {
    return 0;
  }
  return 1 + static_cast<int>(column) + Columns * static_cast<int>(row);
}

} // namespace msi

// A chart of equal patches, found in an image by its four corners.
#pragma once

#include <Eigen/Core>

#include <array>

namespace msi
{

// Which patch a pixel lies in, for a chart of columns x rows patches seen in perspective.
//
// Patches are numbered from 1 along the first row, from the first corner toward the second; then the
// next row. 'fraction' of a cell's width and height, around its middle, belongs to the patch; the rest
// is border and gives 0.
//
// Corners: the outer corners of the chart in pixel coordinates, in the order first patch, end of the first
//          row, last patch, start of the last row (clockwise or counter-clockwise).
// Errors:  std::invalid_argument unless 1 <= columns, rows <= 1000, 0 < fraction <= 1 and the corners
//          are finite and span a convex quadrilateral.
class PatchGrid
{
public:
  using Corners = std::array<Eigen::Vector2d, 4>;

  PatchGrid(int columns, int rows, const Corners& corners, double fraction = 0.5);

  int patches() const noexcept { return Columns * Rows; }
  double fraction() const noexcept { return Fraction; }
  // The same chart with another part of each cell.
  PatchGrid withFraction(double fraction) const;
  // The number of the patch, or 0 between and outside patches.
  int labelAt(double x, double y) const noexcept;

private:
  int Columns;
  int Rows;
  double Fraction;
  Eigen::Matrix3d ToChart; // homography from pixels to (column, row) in 0..columns, 0..rows
};

} // namespace msi

#include "Kernels/Camera/Effects/MovedSpectrum.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr Eigen::Index SlopePoints = 5;
constexpr double RestLength = 20.0; // nm

// row += weight x (slope at node), through the polynomial of the nearest nodes.
void addSlope(
  Eigen::Ref<Eigen::RowVectorXd> row, double weight, const WavelengthGrid& grid, Eigen::Index node)
{
  const Eigen::Index count = std::min(SlopePoints, grid.size());
  const Eigen::Index first =
    std::clamp<Eigen::Index>(node - SlopePoints / 2, 0, grid.size() - count);
  for (Eigen::Index q = first; q < first + count; ++q)
  {
    double slope = q == node ? 0.0 : 1.0 / (grid[q] - grid[node]);
    for (Eigen::Index s = first; s < first + count; ++s)
    {
      if (s == node || s == q)
      {
        continue;
      }
      if (q == node)
      {
        slope += 1.0 / (grid[node] - grid[s]);
      }
      else
      {
        slope *= (grid[node] - grid[s]) / (grid[q] - grid[s]);
      }
    }
    row[q] += weight * slope;
  }
}

void addBeyond(
  Eigen::Ref<Eigen::RowVectorXd> row, const WavelengthGrid& grid, Eigen::Index end, double distance)
{
  row[end] += 1.0;
  addSlope(row, distance / (1.0 + std::abs(distance) / RestLength), grid, end);
}
}

Eigen::MatrixXd movedSpectrum(const WavelengthGrid& grid, const Eigen::ArrayXd& at)
{
  Eigen::MatrixXd operation = Eigen::MatrixXd::Zero(at.size(), grid.size());
  const Eigen::Index last = grid.size() - 1;
  for (Eigen::Index i = 0; i < at.size(); ++i)
  {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(grid.size());
    if (last == 0)
    {
      row[0] = 1.0;
    }
    else if (at[i] <= grid.front())
    {
      addBeyond(row, grid, 0, at[i] - grid.front());
    }
    else if (at[i] >= grid.back())
    {
      addBeyond(row, grid, last, at[i] - grid.back());
    }
    else
    {
      const auto above = std::upper_bound(grid.values().begin(), grid.values().end(), at[i]);
      const auto j = static_cast<Eigen::Index>(above - grid.values().begin()) - 1;
      const double width = grid[j + 1] - grid[j];
      const double t = (at[i] - grid[j]) / width;
      const double blend = t * t * (3.0 - 2.0 * t);
      row[j] += 1.0 - blend;
      row[j + 1] += blend;
      addSlope(row, width * t * (1.0 - t) * (1.0 - t), grid, j);
      addSlope(row, -width * t * t * (1.0 - t), grid, j + 1);
    }
    operation.row(i) = row;
  }
  return operation;
}

} // namespace msi

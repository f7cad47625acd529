#include "Kernels/Camera/Effects/MovedSpectrum.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double RestLength = 20.0; // nm
// Of the largest: far below the last bit of the sum, and most of a passband's flanks.
constexpr double NegligibleWeight = 1e-20;
}

MovedSpectrum::MovedSpectrum(const WavelengthGrid& grid)
  : Grid(grid)
  , Points(std::min(SlopePoints, grid.size()))
{
  const Eigen::Index half = SlopePoints / 2;
  for (Eigen::Index node = 0; node < grid.size(); ++node)
  {
    // Away from the ends of an even grid all are the same.
    const bool likeTheLast = grid.step() && node > half && node + half < grid.size();
    Slopes.push_back(likeTheLast ? Slopes.back() : slopeAt(node));
    Slopes.back().first = std::clamp<Eigen::Index>(node - half, 0, grid.size() - Points);
  }
}

// Of the polynomial through the nearest nodes.
MovedSpectrum::Slope MovedSpectrum::slopeAt(Eigen::Index node) const
{
  Slope slope{ std::clamp<Eigen::Index>(node - SlopePoints / 2, 0, Grid.size() - Points), {} };
  for (Eigen::Index q = slope.first; q < slope.first + Points; ++q)
  {
    double weight = q == node ? 0.0 : 1.0 / (Grid[q] - Grid[node]);
    for (Eigen::Index s = slope.first; s < slope.first + Points; ++s)
    {
      if (s == node || s == q)
      {
        continue;
      }
      if (q == node)
      {
        weight += 1.0 / (Grid[node] - Grid[s]);
      }
      else
      {
        weight *= (Grid[node] - Grid[s]) / (Grid[q] - Grid[s]);
      }
    }
    slope.weight[static_cast<std::size_t>(q - slope.first)] = weight;
  }
  return slope;
}

void MovedSpectrum::addBeyond(double weight, Eigen::Index end, double distance, Parts& parts) const
{
  parts.value[end] += weight;
  parts.slope[end] += weight * distance / (1.0 + std::abs(distance) / RestLength);
}

void MovedSpectrum::add(double weight, double at, Parts& parts) const
{
  const Eigen::Index last = Grid.size() - 1;
  if (last == 0)
  {
    parts.value[0] += weight;
  }
  else if (at <= Grid.front())
  {
    addBeyond(weight, 0, at - Grid.front(), parts);
  }
  else if (at >= Grid.back())
  {
    addBeyond(weight, last, at - Grid.back(), parts);
  }
  else
  {
    const auto above = std::upper_bound(Grid.values().begin(), Grid.values().end(), at);
    const auto j = static_cast<Eigen::Index>(above - Grid.values().begin()) - 1;
    const double width = Grid[j + 1] - Grid[j];
    const double t = (at - Grid[j]) / width;
    const double blend = t * t * (3.0 - 2.0 * t);
    parts.value[j] += weight * (1.0 - blend);
    parts.value[j + 1] += weight * blend;
    parts.slope[j] += weight * width * t * (1.0 - t) * (1.0 - t);
    parts.slope[j + 1] -= weight * width * t * t * (1.0 - t);
  }
}

Eigen::RowVectorXd MovedSpectrum::rowOf(const Parts& parts) const
{
  Eigen::RowVectorXd row = parts.value;
  for (Eigen::Index node = 0; node < Grid.size(); ++node)
  {
    const double weight = parts.slope[node];
    if (weight != 0.0)
    {
      const Slope& slope = Slopes[static_cast<std::size_t>(node)];
      for (Eigen::Index q = 0; q < Points; ++q)
      {
        row[slope.first + q] += weight * slope.weight[static_cast<std::size_t>(q)];
      }
    }
  }
  return row;
}

Eigen::MatrixXd MovedSpectrum::operation(const Eigen::ArrayXd& at) const
{
  Eigen::MatrixXd rows(at.size(), Grid.size());
  for (Eigen::Index i = 0; i < at.size(); ++i)
  {
    Parts parts(Grid.size());
    add(1.0, at[i], parts);
    rows.row(i) = rowOf(parts);
  }
  return rows;
}

Eigen::RowVectorXd MovedSpectrum::weighted(
  const Eigen::ArrayXd& weights, const Eigen::ArrayXd& at) const
{
  Parts parts(Grid.size());
  const double least = NegligibleWeight * weights.abs().maxCoeff();
  for (Eigen::Index i = 0; i < at.size(); ++i)
  {
    if (std::abs(weights[i]) > least)
    {
      add(weights[i], at[i], parts);
    }
  }
  return rowOf(parts);
}

} // namespace msi

#include "Kernels/Sampling/PatchLattice.h"

#include "Kernels/Sampling/Homography.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>

namespace msi
{

namespace
{
using Cell = std::pair<int, int>;
using Members = std::map<Cell, std::size_t>; // of a region

constexpr double Tolerance = 0.25; // of a cell, on the way from neighbour to neighbour
constexpr double LargestResidual = 0.2;
constexpr std::size_t Neighbours = 8;
constexpr std::array<Cell, 4> Steps{ Cell{ 1, 0 }, Cell{ -1, 0 }, Cell{ 0, 1 }, Cell{ 0, -1 } };

bool areAlike(const EvenRegion& a, const EvenRegion& b)
{
  return a.area <= 2.0 * b.area && b.area <= 2.0 * a.area;
}

std::vector<std::size_t> neighboursOf(const std::vector<EvenRegion>& regions, std::size_t seed)
{
  constexpr double Farthest = 4.0; // sides of the region
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    if (i != seed && areAlike(regions[i], regions[seed]) &&
      (regions[i].center - regions[seed].center).norm() < Farthest * std::sqrt(regions[seed].area))
    {
      near.push_back(i);
    }
  }
  std::sort(near.begin(), near.end(),
    [&](std::size_t a, std::size_t b)
    {
      return (regions[a].center - regions[seed].center).squaredNorm() <
        (regions[b].center - regions[seed].center).squaredNorm();
    });
  near.resize(std::min(near.size(), Neighbours));
  return near;
}

// The step from a cell to its neighbour, from what is known around it; else the one that led there.
Eigen::Vector2d stepFrom(const std::vector<EvenRegion>& regions, const Members& members,
  const Cell& cell, const Cell& step, const Eigen::Vector2d& usual)
{
  const auto here = members.find(cell);
  const auto before = members.find({ cell.first - step.first, cell.second - step.second });
  if (before != members.end())
  {
    return regions[here->second].center - regions[before->second].center;
  }
  // A parallel step in the next row or column.
  for (const int side : { -1, 1 })
  {
    const Cell beside{ cell.first + side * step.second, cell.second + side * step.first };
    const auto a = members.find(beside);
    const auto b = members.find({ beside.first + step.first, beside.second + step.second });
    if (a != members.end() && b != members.end())
    {
      return regions[b->second].center - regions[a->second].center;
    }
  }
  return usual;
}

std::optional<std::size_t> regionAt(const std::vector<EvenRegion>& regions,
  const Eigen::Vector2d& place, double tolerance, const EvenRegion& like,
  const std::set<std::size_t>& taken)
{
  std::optional<std::size_t> best;
  double nearest = tolerance;
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    const double distance = (regions[i].center - place).norm();
    if (distance < nearest && areAlike(regions[i], like) && taken.count(i) == 0)
    {
      nearest = distance;
      best = i;
    }
  }
  return best;
}

Members grow(
  const std::vector<EvenRegion>& regions, std::size_t seed, std::size_t first, std::size_t second)
{
  const Eigen::Vector2d u = regions[first].center - regions[seed].center;
  const Eigen::Vector2d v = regions[second].center - regions[seed].center;
  Members members{ { { 0, 0 }, seed }, { { 1, 0 }, first }, { { 0, 1 }, second } };
  std::set<std::size_t> taken{ seed, first, second };
  std::deque<Cell> open{ { 0, 0 }, { 1, 0 }, { 0, 1 } };
  while (!open.empty())
  {
    const Cell cell = open.front();
    open.pop_front();
    for (const auto& step : Steps)
    {
      const Cell next{ cell.first + step.first, cell.second + step.second };
      if (members.count(next) != 0)
      {
        continue;
      }
      const Eigen::Vector2d usual = step.first * u + step.second * v;
      const Eigen::Vector2d move = stepFrom(regions, members, cell, step, usual);
      const auto& here = regions[members.at(cell)];
      const auto found = regionAt(
        regions, here.center + move, Tolerance * std::min(u.norm(), v.norm()), here, taken);
      if (found)
      {
        members[next] = *found;
        taken.insert(*found);
        open.push_back(next);
      }
    }
  }
  return members;
}

// Of the cell around a place of the lattice, to first order.
double cellArea(const Eigen::Matrix3d& toImage, const Eigen::Vector2d& cell)
{
  const double depth = toImage.row(2).dot(cell.homogeneous());
  return std::abs(toImage.determinant() / (depth * depth * depth));
}

// The common homography; what does not follow it leaves, and what follows it joins.
std::optional<PatchLattice> fitted(
  const std::vector<EvenRegion>& regions, Members members, std::size_t least)
{
  PatchLattice lattice;
  constexpr int Rounds = 4;
  for (int round = 0; round < Rounds; ++round)
  {
    if (members.size() < least)
    {
      return std::nullopt;
    }
    std::vector<Eigen::Vector2d> cells;
    std::vector<Eigen::Vector2d> places;
    for (const auto& [cell, region] : members)
    {
      cells.emplace_back(cell.first, cell.second);
      places.push_back(regions[region].center);
    }
    try
    {
      lattice.toImage = fitHomography(cells, places);
    }
    catch (const std::invalid_argument&)
    {
      return std::nullopt;
    }
    const Eigen::Matrix3d toCell = lattice.toImage.inverse();
    // Perspective changes areas over the chart; as shares of their cells they are alike.
    std::vector<double> shares;
    for (const auto& [cell, region] : members)
    {
      shares.push_back(
        regions[region].area / cellArea(lattice.toImage, { cell.first, cell.second }));
    }
    std::nth_element(shares.begin(),
      shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
    const double typical = shares[shares.size() / 2];
    Members next;
    std::map<Cell, double> distances;
    for (std::size_t i = 0; i < regions.size(); ++i)
    {
      const Eigen::Vector2d at = mapPoint(toCell, regions[i].center);
      constexpr double Far = 1000.0;
      if (!at.allFinite() || at.cwiseAbs().maxCoeff() > Far)
      {
        continue;
      }
      const double share = regions[i].area / cellArea(lattice.toImage, at);
      if (!(share <= 2.0 * typical && typical <= 2.0 * share))
      {
        continue;
      }
      const Eigen::Vector2d whole = at.array().round();
      const Cell cell(static_cast<int>(whole.x()), static_cast<int>(whole.y()));
      const double distance = (at - whole).norm();
      if (distance <= LargestResidual && (distances.count(cell) == 0 || distance < distances[cell]))
      {
        distances[cell] = distance;
        next[cell] = i;
      }
    }
    double squares = 0.0;
    for (const auto& [cell, distance] : distances)
    {
      squares += distance * distance;
    }
    lattice.residual = std::sqrt(squares / std::max<double>(1.0, static_cast<double>(next.size())));
    const bool same = next == members;
    members = std::move(next);
    if (same)
    {
      break;
    }
  }
  if (members.size() < least)
  {
    return std::nullopt;
  }
  for (const auto& [cell, region] : members)
  {
    lattice.places[cell] = regions[region].center;
  }
  return lattice;
}

// Cells of the smallest box around the lattice: a lattice that counts along a diagonal needs a larger one.
int boxSize(const PatchLattice& lattice)
{
  Eigen::AlignedBox2i box;
  for (const auto& [cell, place] : lattice.places)
  {
    box.extend(Eigen::Vector2i(cell.first, cell.second));
  }
  return (box.sizes().array() + 1).prod();
}

// Two ways to count the same regions: those of a lattice of every second region come out smaller.
bool shareRegions(const PatchLattice& a, const PatchLattice& b)
{
  std::size_t common = 0;
  for (const auto& [cell, place] : b.places)
  {
    common += std::any_of(a.places.begin(), a.places.end(),
                [&place = place](const auto& other) { return other.second == place; })
      ? 1
      : 0;
  }
  return 2 * common > b.places.size();
}
}

std::vector<PatchLattice> findLattices(
  const std::vector<EvenRegion>& regions, std::size_t least, std::size_t most)
{
  std::vector<PatchLattice> lattices;
  std::set<std::array<std::size_t, 3>> seen;
  for (std::size_t seed = 0; seed < regions.size(); ++seed)
  {
    const auto near = neighboursOf(regions, seed);
    for (const std::size_t first : near)
    {
      for (const std::size_t second : near)
      {
        const Eigen::Vector2d u = regions[first].center - regions[seed].center;
        const Eigen::Vector2d v = regions[second].center - regions[seed].center;
        constexpr double LeastSine = 0.5;
        const double sine = (u.x() * v.y() - u.y() * v.x()) / (u.norm() * v.norm());
        if (!(sine >= LeastSine) || seen.count({ seed, first, second }) != 0)
        {
          continue;
        }
        const Members members = grow(regions, seed, first, second);
        if (members.size() < least)
        {
          continue;
        }
        // Every corner of the lattice would grow the same one.
        for (const auto& [cell, region] : members)
        {
          const auto right = members.find({ cell.first + 1, cell.second });
          const auto below = members.find({ cell.first, cell.second + 1 });
          if (right != members.end() && below != members.end())
          {
            seen.insert({ region, right->second, below->second });
          }
        }
        if (auto lattice = fitted(regions, members, least))
        {
          lattices.push_back(std::move(*lattice));
        }
      }
    }
  }
  std::stable_sort(lattices.begin(), lattices.end(),
    [](const PatchLattice& a, const PatchLattice& b)
    {
      return a.places.size() != b.places.size() ? a.places.size() > b.places.size()
                                                : boxSize(a) < boxSize(b);
    });
  std::vector<PatchLattice> distinct;
  for (auto& lattice : lattices)
  {
    const bool known = std::any_of(distinct.begin(), distinct.end(),
      [&](const PatchLattice& other) { return shareRegions(other, lattice); });
    if (!known && distinct.size() < most)
    {
      distinct.push_back(std::move(lattice));
    }
  }
  return distinct;
}

} // namespace msi

#include "Kernels/Gap/GapCells.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace msi
{

namespace
{
constexpr std::size_t CellsNamed = 5;
}

std::vector<GapCell> GapCells::worst() const
{
  std::vector<GapCell> cells;
  for (const auto& [name, energy] : Energy)
  {
    if (energy > 0.0 && Total > 0.0)
    {
      cells.push_back({ name, std::fmin(energy / Total, 1.0) });
    }
  }
  std::stable_sort(cells.begin(), cells.end(),
    [](const GapCell& a, const GapCell& b) { return a.share > b.share; });
  cells.resize(std::min(cells.size(), CellsNamed));
  return cells;
}

std::string thirdOfField(double value, const char* axis)
{
  const char* range = value < -1.0 / 3.0 ? " -1..-0.33"
    : value < 1.0 / 3.0                  ? " -0.33..0.33"
                                         : " 0.33..1";
  return std::string(axis) + range;
}

std::string rounded(double value)
{
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

std::string rangeText(const std::string& what, double low, double high)
{
  std::ostringstream text;
  text.precision(3);
  text << what << ' ' << low << ".." << high;
  return text.str();
}

GapCells fifths(std::vector<std::pair<double, double>> pairs, const std::string& name)
{
  GapCells cells;
  std::stable_sort(
    pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t n = pairs.size();
  const bool alike = n < 5 || !(pairs.front().first < pairs.back().first);
  for (std::size_t part = 0; part < 5 && !alike; ++part)
  {
    const std::size_t first = part * n / 5;
    const std::size_t last = (part + 1) * n / 5;
    const std::string cell =
      name + " " + rounded(pairs[first].first) + ".." + rounded(pairs[last - 1].first);
    for (std::size_t i = first; i < last; ++i)
    {
      cells.add(cell, pairs[i].second);
    }
  }
  return cells;
}

} // namespace msi

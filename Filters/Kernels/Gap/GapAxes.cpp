#include "Kernels/Gap/GapAxes.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Shrink.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr std::size_t CellsNamed = 5;
constexpr double Alike = 1e-9;             // shares
constexpr std::size_t ChannelAndLevel = 3; // their bits

// The first axis and its worst cell.
std::string whereIs(const std::vector<GapAxis>& axes)
{
  if (axes.empty())
  {
    return "no axis stands out";
  }
  const GapAxis& axis = axes.front();
  if (axis.worst.empty())
  {
    return axis.axis;
  }
  const std::string& cell = axis.worst.front().cell;
  return cell.rfind(axis.axis, 0) == 0 ? cell : axis.axis + " " + cell;
}

// What a rest depends on, from its shares over the axes: GapRemainder::dependsOn.
std::vector<std::pair<std::string, double>> dependences(const std::vector<GapAxis>& axes)
{
  static const std::map<std::string, std::string> plain = { { "channel", "wavelength" },
    { "spectral_shape", "wavelength" }, { "edges", "neighbour" }, { "region", "position" },
    { "rows", "position" }, { "columns", "position" } };
  std::map<std::string, double> parts;
  for (const GapAxis& axis : axes)
  {
    const auto known = plain.find(axis.axis);
    parts[known == plain.end() ? axis.axis : known->second] += axis.share;
  }
  std::vector<std::pair<std::string, double>> sorted(parts.begin(), parts.end());
  std::stable_sort(
    sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}
}

double energyLeft(const Eigen::MatrixXd& normal, const Eigen::VectorXd& change)
{
  const Eigen::Index count = change.size();
  return normal(count, count) - 2.0 * change.dot(normal.col(count).head(count)) +
    change.dot(normal.topLeftCorner(count, count) * change);
}

std::vector<double> shapleyOfAxes(std::size_t axes,
  const std::function<double(std::size_t)>& explained, const std::function<void()>& contrast)
{
  const std::size_t subsets = std::size_t(1) << axes;
  if (explained(ChannelAndLevel) >= (1.0 - Decision::SmallPart) * explained(subsets - 1))
  {
    contrast();
  }
  std::vector<double> value(subsets, 0.0);
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    value[subset] = explained(subset);
  }
  return shapleyValues(value, axes);
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

std::string rangeText(const std::string& what, double low, double high, int digits)
{
  return textOf(digits, what, ' ', low, "..", high);
}

GapPart::GapPart(double value, double from, double to, int parts) noexcept
{
  const double width = (to - from) / parts;
  const double at = width > 0.0 ? std::floor((value - from) / width) : 0.0;
  const double part = std::fmin(std::fmax(at, 0.0), parts - 1.0);
  low = from + part * width;
  high = from + (part + 1.0) * width;
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
    const std::string cell = rangeText(name, pairs[first].first, pairs[last - 1].first, 2);
    for (std::size_t i = first; i < last; ++i)
    {
      cells.add(cell, pairs[i].second);
    }
  }
  return cells;
}

std::vector<GapAxis> worthNaming(std::vector<GapAxis> axes)
{
  axes.erase(std::remove_if(axes.begin(), axes.end(),
               [](const GapAxis& axis) { return !(axis.share > Decision::FormPart); }),
    axes.end());
  // Two axes may be the same: scenes of one medium each. Then rounding does not say which comes first.
  std::stable_sort(axes.begin(), axes.end(),
    [](const GapAxis& a, const GapAxis& b)
    { return std::round(a.share / Alike) > std::round(b.share / Alike); });
  return axes;
}

GapRemainder remainderOf(double share, const std::vector<GapAxis>& axes)
{
  return { share, whereIs(axes), dependences(axes) };
}

} // namespace msi

#include "Kernels/Gap/GapProfile.h"

#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/OrderStatistic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>

namespace msi
{

namespace
{
constexpr int Parts = 5;
constexpr int FieldParts = 3;
constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

void addNamed(
  std::vector<SampleGroup>& groups, const char* kind, const std::vector<std::string>& names)
{
  std::vector<SampleGroup> found;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const auto [at, first] = place.emplace(names[i], found.size());
    if (first)
    {
      found.push_back({ kind, names[i], {} });
    }
    found[at->second].samples.push_back(i);
  }
  if (found.size() > 1)
  {
    groups.insert(groups.end(), found.begin(), found.end());
  }
}

std::vector<Eigen::Index> sorted(const Eigen::VectorXd& values)
{
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < values.size(); ++i)
  {
    if (std::isfinite(values[i]))
    {
      order.push_back(i);
    }
  }
  std::stable_sort(order.begin(), order.end(),
    [&values](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  return order;
}

// Parts of equal size, in the order of the values.
void addParts(std::vector<SampleGroup>& groups, const char* kind, const Eigen::VectorXd& values)
{
  const std::vector<Eigen::Index> order = sorted(values);
  if (order.empty() || values[order.front()] == values[order.back()])
  {
    return;
  }
  const std::size_t count = order.size();
  for (std::size_t part = 0; part < Parts; ++part)
  {
    const std::size_t begin = part * count / Parts;
    const std::size_t end = (part + 1) * count / Parts;
    if (begin < end)
    {
      groups.push_back({ kind, rangeText(kind, values[order[begin]], values[order[end - 1]]),
        { order.begin() + begin, order.begin() + end } });
    }
  }
}

void addField(std::vector<SampleGroup>& groups, const Eigen::VectorXd& x, const Eigen::VectorXd& y)
{
  const std::vector<Eigen::Index> byX = sorted(x);
  const std::vector<Eigen::Index> byY = sorted(y);
  if (byX.empty() || byY.empty())
  {
    return;
  }
  const double left = x[byX.front()];
  const double right = x[byX.back()];
  const double low = y[byY.front()];
  const double high = y[byY.back()];
  if (left == right && low == high)
  {
    return;
  }
  std::map<std::pair<double, double>, SampleGroup> cells; // by row and column
  for (Eigen::Index i = 0; i < x.size(); ++i)
  {
    if (std::isfinite(x[i]) && std::isfinite(y[i]))
    {
      const GapPart column(x[i], left, right, FieldParts);
      const GapPart row(y[i], low, high, FieldParts);
      const SampleGroup empty{ "position", column.text("x") + ", " + row.text("y"), {} };
      cells.try_emplace({ row.low, column.low }, empty).first->second.samples.push_back(i);
    }
  }
  for (auto& [place, cell] : cells)
  {
    groups.push_back(std::move(cell));
  }
}

double median(const Eigen::VectorXd& values)
{
  const Eigen::Index count = values.size();
  return count == 0
    ? Nothing
    : 0.5 * (orderStatistic(values, count / 2) + orderStatistic(values, (count - 1) / 2));
}

// By the medians of the first and the last third, as J. W. Tukey (Exploratory Data Analysis, 1977): outliers do not pull it.
Eigen::VectorXd resistantLine(const Eigen::VectorXd& x, const Eigen::VectorXd& y)
{
  const Eigen::Index third = x.size() / 3;
  const double run = third > 0 ? median(x.tail(third)) - median(x.head(third)) : 0.0;
  const double rise = run > 0.0 ? median(y.tail(third)) - median(y.head(third)) : 0.0;
  const Eigen::VectorXd along = run > 0.0 ? Eigen::VectorXd(rise / run * x) : 0.0 * x;
  return along.array() + median(y - along);
}
}

std::vector<SampleGroup> groupSamples(const SceneSamples& samples)
{
  std::vector<SampleGroup> groups;
  addNamed(groups, "medium", samples.medium);
  addNamed(groups, "scene", samples.scene);
  addParts(groups, "reflectance", samples.reflectance.colwise().mean().transpose());
  addParts(groups, "order", samples.order);
  addField(groups, samples.x, samples.y);
  return groups;
}

GroupedGap groupGap(const Eigen::MatrixXd& gap, const std::vector<SampleGroup>& groups)
{
  const Eigen::Index count = groups.size();
  GroupedGap result{ Eigen::MatrixXd(gap.rows(), count), Eigen::MatrixXd(gap.rows(), count) };
  for (Eigen::Index g = 0; g < count; ++g)
  {
    const Eigen::ArrayXXd some = gap(Eigen::all, groups[g].samples);
    const Eigen::ArrayXXd known = some.isFinite().select(some, 0.0);
    const Eigen::ArrayXd number = some.isFinite().cast<double>().rowwise().sum();
    result.mean.col(g) = known.rowwise().sum() / number;
    result.rms.col(g) = (known.square().rowwise().sum() / number).sqrt();
  }
  return result;
}

Eigen::VectorXd relativeGap(const Eigen::MatrixXd& gap, const Eigen::MatrixXd& simulated)
{
  const auto measured = gap.array().isFinite() && simulated.array().isFinite();
  const Eigen::ArrayXd size = measured.select(simulated.array(), 0.0).colwise().sum();
  const Eigen::ArrayXd sum = measured.select(gap.array(), 0.0).colwise().sum();
  return (size > 0.0).select(sum / size, Nothing);
}

GapTrend trendOf(
  const SceneSamples& samples, const GapReport& report, const Eigen::MatrixXd& simulated)
{
  const Eigen::VectorXd before = relativeGap(report.gapBefore, simulated);
  const Eigen::VectorXd after = relativeGap(report.gapAfter, simulated);
  GapTrend trend;
  for (const Eigen::Index i : sorted(samples.order))
  {
    if (std::isfinite(before[i]))
    {
      trend.sample.push_back(i);
    }
  }
  trend.order = samples.order(trend.sample);
  trend.before = before(trend.sample);
  trend.after = after(trend.sample);
  std::vector<double> steps;
  steps.reserve(report.changePoints.size());
  for (const GapChangePoint& change : report.changePoints)
  {
    steps.push_back(change.order);
  }
  std::sort(steps.begin(), steps.end());
  trend.level.resize(trend.before.size());
  Eigen::Index begin = 0;
  for (std::size_t step = 0; step <= steps.size(); ++step)
  {
    Eigen::Index end = begin;
    while (end < trend.order.size() && (step == steps.size() || trend.order[end] < steps[step]))
    {
      ++end;
    }
    trend.level.segment(begin, end - begin) = resistantLine(
      trend.order.segment(begin, end - begin), trend.before.segment(begin, end - begin));
    begin = end;
  }
  return trend;
}

} // namespace msi

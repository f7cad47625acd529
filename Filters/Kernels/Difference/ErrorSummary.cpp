#include "Kernels/Difference/ErrorSummary.h"

#include "Kernels/Difference/Percentile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace msi
{

namespace
{
std::vector<double> sortedFinite(const Eigen::Ref<const Eigen::VectorXd>& values)
{
  std::vector<double> sorted;
  sorted.reserve(static_cast<std::size_t>(values.size()));
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
    [](double value) { return std::isfinite(value); });
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double percentileOfSorted(const std::vector<double>& sorted, double percent)
{
  const auto position = percentilePosition(static_cast<std::int64_t>(sorted.size()), percent);
  return interpolate(sorted[static_cast<std::size_t>(position.lower)],
    sorted[static_cast<std::size_t>(position.upper)], position.fraction);
}
}

ErrorSummary emptySummary(std::int64_t nonFinite)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  return { 0, nonFinite, none, none, none, none, none };
}

// Sums run in sorted order, so that the order of the samples makes no difference.
ErrorSummary summarize(const Eigen::Ref<const Eigen::VectorXd>& values)
{
  const std::vector<double> sorted = sortedFinite(values);
  const auto count = static_cast<std::int64_t>(sorted.size());
  ErrorSummary summary = emptySummary(values.size() - count);
  if (sorted.empty())
  {
    return summary;
  }
  double sum = 0.0;
  for (const double value : sorted)
  {
    sum += value;
  }
  summary.count = count;
  summary.mean = sum / static_cast<double>(count);
  double squares = 0.0;
  for (const double value : sorted)
  {
    squares += (value - summary.mean) * (value - summary.mean);
  }
  summary.standardDeviation = std::sqrt(squares / static_cast<double>(count));
  summary.median = percentileOfSorted(sorted, 50.0);
  summary.p95 = percentileOfSorted(sorted, 95.0);
  summary.max = sorted.back();
  return summary;
}

double percentile(const Eigen::Ref<const Eigen::VectorXd>& values, double percent)
{
  const std::vector<double> sorted = sortedFinite(values);
  if (sorted.empty() || !(percent >= 0.0 && percent <= 100.0))
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return percentileOfSorted(sorted, percent);
}

} // namespace msi

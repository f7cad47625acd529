// Where a percentile lies in a sorted list; shared by the summaries of this folder.
#pragma once

#include "Kernels/Difference/ErrorSummary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace msi
{

// The two order statistics, from 0, that a percentile lies between.
struct PercentilePosition
{
  std::int64_t lower;
  std::int64_t upper;
  double fraction;
};

// Linear interpolation between order statistics (numpy's default). Needs count > 0, percent 0..100.
inline PercentilePosition percentilePosition(std::int64_t count, double percent)
{
  const double position = static_cast<double>(count - 1) * (percent / 100.0);
  const auto lower = static_cast<std::int64_t>(std::floor(position));
  return { lower, std::min(lower + 1, count - 1), position - std::floor(position) };
}

inline double interpolate(double lower, double upper, double fraction)
{
  return lower + (upper - lower) * fraction;
}

// The summary of no finite values.
ErrorSummary emptySummary(std::int64_t nonFinite);

} // namespace msi

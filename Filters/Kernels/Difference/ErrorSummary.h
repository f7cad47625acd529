// The figures that a table of errors states.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace msi
{

// Statistics of the finite values. Where there is none, every figure but the counts is NaN.
struct ErrorSummary
{
  std::int64_t count = 0;     // finite values
  std::int64_t nonFinite = 0; // NaN and infinite values, left out of all else
  double mean = 0.0;
  double standardDeviation = 0.0; // of the population: divided by count
  double median = 0.0;
  double p95 = 0.0; // percentiles interpolate linearly between order statistics (numpy's default)
  double max = 0.0;
};

// The summary of values that are all at hand. Sorts a copy: O(n log n) time, O(n) memory.
ErrorSummary summarize(const Eigen::Ref<const Eigen::VectorXd>& values);

// The percentile, 0..100, with linear interpolation between order statistics, over the finite
// values: position (n - 1) percent / 100 in the sorted list. NaN where there is none.
double percentile(const Eigen::Ref<const Eigen::VectorXd>& values, double percent);

} // namespace msi

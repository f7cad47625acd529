// The second pass of the statistics of an image of errors: median, 95th percentile and maximum.
#pragma once

#include "Kernels/Difference/ErrorStatistics.h"
#include "Kernels/Difference/ErrorSummary.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace msi
{

// The second pass over the same values: the order statistics that the median, the 95th percentile
// and the maximum rest on, exact to the bit. Built from the merged first pass, equal on all ranks.
//
// Memory: half a megabyte for each distinct upper half of the floats looked for, at most five.
class ErrorOrderStatistics
{
public:
  explicit ErrorOrderStatistics(const ErrorStatistics& firstPass);

  void add(const float* values, std::size_t count) noexcept;
  void merge(const ErrorOrderStatistics& other) noexcept;

  const std::vector<std::int64_t>& toArray() const noexcept { return State; }
  // Replaces the state by a sum of toArray() over ranks with the same first pass.
  // Throws std::invalid_argument where the length differs.
  void setArray(std::vector<std::int64_t> state);

  // All figures. Throws std::logic_error where the values of the two passes were not the same.
  ErrorSummary summary() const;

private:
  // An order statistic: its rank among the values that share the upper half of its bits.
  struct Target
  {
    std::int64_t rankInBin;
    std::int64_t binCount;
    std::size_t slot; // which fine histogram
  };

  Target locate(const ErrorStatistics& firstPass, std::int64_t rank);
  double valueAt(const Target& target) const;

  ErrorSummary Summary;
  std::vector<Target> Targets;
  std::vector<std::uint16_t> Bins;
  std::vector<std::int64_t> State;
};

// Both passes over values that are all at hand; equal to the bit to any split of the same values.
ErrorSummary summarize(const float* values, std::size_t count);

} // namespace msi

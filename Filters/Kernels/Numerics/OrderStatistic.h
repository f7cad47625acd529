// Medians and other order statistics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace msi
{

// The value that stands behind `before` others once all are sorted. size / 2 gives the median; of an even number of values it is
// the larger of the two in the middle. Values: a list with begin() and end(), not empty.
template <typename Values>
double orderStatistic(const Values& values, std::ptrdiff_t before)
{
  std::vector<double> sorted(values.begin(), values.end());
  std::nth_element(sorted.begin(), sorted.begin() + before, sorted.end());
  return sorted[static_cast<std::size_t>(before)];
}

} // namespace msi

// Statistics of an image of errors in pieces, with the same bytes for every partition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace msi
{

// The first of two passes over float values: count, exact sums and a histogram.
//
// Every member is an integer that adds up, so that any split over threads, pieces and ranks, merged
// in any order, holds the same state, and all figures are functions of that state.
//
// Ranges: every finite float, of either sign; up to 2^38 values.
// Exact:  the sum and the sum of squares are exact; mean and standard deviation are rounded from
//         them to double with a relative error below 1e-15.
// Memory: half a megabyte, whatever the number of values. Cost: a few nanoseconds a value.
// Ranks:  toArray() of all ranks, summed element by element, is fromArray()'s state of the whole.
class ErrorStatistics
{
public:
  ErrorStatistics();

  void add(const float* values, std::size_t count) noexcept;
  void merge(const ErrorStatistics& other) noexcept;

  std::int64_t count() const noexcept;     // finite values
  std::int64_t nonFinite() const noexcept; // NaN and infinite values, left out
  double mean() const;
  double standardDeviation() const; // of the population: divided by count

  // How many values share each upper half of their keys, in the order of the values; 65536 counts.
  const std::int64_t* histogram() const noexcept;

  const std::vector<std::int64_t>& toArray() const noexcept { return State; }
  // Throws std::invalid_argument where the length is not that of toArray().
  static ErrorStatistics fromArray(std::vector<std::int64_t> state);

private:
  std::vector<std::int64_t> State;
};

} // namespace msi

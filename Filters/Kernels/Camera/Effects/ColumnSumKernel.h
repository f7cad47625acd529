// The inner loop of stray light on tables: a weighted sum of other samples' signals.
#pragma once

#include <cstddef>

namespace msi
{

// sum = weights[0] column(chosen[0]) + weights[1] column(chosen[1]) + ..., in this order, every product and sum rounded
// once. columns: `rows` values a column, one column after the other. SIMD chosen at run time (Highway).
void weightedColumnSum(const double* columns, std::size_t rows, const int* chosen,
  const double* weights, std::size_t count, double* sum) noexcept;

} // namespace msi

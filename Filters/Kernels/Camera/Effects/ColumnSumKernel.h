// The inner loop of stray light on tables: a weighted sum of other samples' signals.
#pragma once

#include <cstddef>

namespace msi
{

// sum[k] = weights[0] columns[0][k] + weights[1] columns[1][k] + ..., in this order, every product and sum rounded once.
// SIMD chosen at run time (Highway).
void weightedColumnSum(const double* const* columns, const double* weights, std::size_t count,
  double* sum, std::size_t rows) noexcept;

} // namespace msi

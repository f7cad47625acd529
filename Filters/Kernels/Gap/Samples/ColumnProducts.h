// Inner products of long columns: what normal equations are made of.
#pragma once

#include <Eigen/Core>

namespace msi
{

// left^T right, for matrices with the same number of rows and many more rows than columns.
// Row i adds to the i modulo 8-th of eight sums, which are added last; products and sums are rounded one by one. So the
// bits depend neither on the instruction set nor on the other columns. SIMD chosen at run time (Highway).
Eigen::MatrixXd columnProducts(
  const Eigen::Ref<const Eigen::MatrixXd>& left, const Eigen::Ref<const Eigen::MatrixXd>& right);

// columns^T columns, the same bits for half the price.
Eigen::MatrixXd columnProducts(const Eigen::Ref<const Eigen::MatrixXd>& columns);

} // namespace msi

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Gap/Samples/ColumnProducts.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Gap/Samples/ColumnProducts.h"

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t Sums = 8; // of one product

// `Columns` products of one left column, with right columns that lie `stride` apart.
template <int Columns>
HWY_INLINE void multiply(
  const double* left, const double* right, std::size_t stride, std::size_t rows, double* products)
{
  const hn::CappedTag<double, Sums> d;
  const std::size_t whole = rows / Sums * Sums;
  HWY_ALIGN double sums[Columns * Sums];
  for (std::size_t first = 0; first < Sums; first += hn::Lanes(d))
  {
    auto sum0 = hn::Zero(d);
    auto sum1 = sum0;
    auto sum2 = sum0;
    auto sum3 = sum0;
    for (std::size_t i = first; i < whole; i += Sums)
    {
      const auto mine = hn::LoadU(d, left + i);
      const double* other = right + i;
      sum0 = hn::Add(sum0, hn::Mul(mine, hn::LoadU(d, other)));
      if constexpr (Columns == 4)
      {
        sum1 = hn::Add(sum1, hn::Mul(mine, hn::LoadU(d, other + stride)));
        sum2 = hn::Add(sum2, hn::Mul(mine, hn::LoadU(d, other + 2 * stride)));
        sum3 = hn::Add(sum3, hn::Mul(mine, hn::LoadU(d, other + 3 * stride)));
      }
    }
    hn::StoreU(sum0, d, sums + first);
    if constexpr (Columns == 4)
    {
      hn::StoreU(sum1, d, sums + Sums + first);
      hn::StoreU(sum2, d, sums + 2 * Sums + first);
      hn::StoreU(sum3, d, sums + 3 * Sums + first);
    }
  }
  for (int c = 0; c < Columns; ++c)
  {
    double* mine = sums + static_cast<std::size_t>(c) * Sums;
    for (std::size_t i = whole; i < rows; ++i)
    {
      mine[i - whole] += left[i] * right[static_cast<std::size_t>(c) * stride + i];
    }
    products[c] = 0.0;
    for (std::size_t s = 0; s < Sums; ++s)
    {
      products[c] += mine[s];
    }
  }
}

void multiplyAll(const double* left, const double* right, std::size_t stride, std::size_t rows,
  std::size_t columns, double* products)
{
  std::size_t c = 0;
  for (; c + 4 <= columns; c += 4)
  {
    multiply<4>(left, right + c * stride, stride, rows, products + c);
  }
  for (; c < columns; ++c)
  {
    multiply<1>(left, right + c * stride, stride, rows, products + c);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(multiplyAll);

Eigen::MatrixXd columnProducts(
  const Eigen::Ref<const Eigen::MatrixXd>& left, const Eigen::Ref<const Eigen::MatrixXd>& right)
{
  const auto multiplyEach = HWY_DYNAMIC_DISPATCH(multiplyAll);
  Eigen::MatrixXd products(right.cols(), left.cols());
  for (Eigen::Index c = 0; c < left.cols(); ++c)
  {
    multiplyEach(left.col(c).data(), right.data(), static_cast<std::size_t>(right.outerStride()),
      static_cast<std::size_t>(left.rows()), static_cast<std::size_t>(right.cols()),
      products.col(c).data());
  }
  return products.transpose();
}

Eigen::MatrixXd columnProducts(const Eigen::Ref<const Eigen::MatrixXd>& columns)
{
  const auto multiplyEach = HWY_DYNAMIC_DISPATCH(multiplyAll);
  const auto stride = static_cast<std::size_t>(columns.outerStride());
  Eigen::MatrixXd products(columns.cols(), columns.cols());
  for (Eigen::Index c = 0; c < columns.cols(); ++c)
  {
    multiplyEach(columns.col(c).data(), columns.col(c).data(), stride,
      static_cast<std::size_t>(columns.rows()), static_cast<std::size_t>(columns.cols() - c),
      products.col(c).data() + c);
  }
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
  return products;
}

} // namespace msi
#endif

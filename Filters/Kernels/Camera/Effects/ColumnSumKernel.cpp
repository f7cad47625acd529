#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Camera/Effects/ColumnSumKernel.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Camera/Effects/ColumnSumKernel.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// `Vectors` vectors of rows from `first` on.
template <int Vectors, class D>
HWY_INLINE void sumRows(D d, const double* const* columns, const double* weights, std::size_t count,
  double* sum, std::size_t first)
{
  const std::size_t lanes = hn::Lanes(d);
  auto sum0 = hn::Zero(d);
  auto sum1 = sum0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto weight = hn::Set(d, weights[i]);
    const double* rows = columns[i] + first;
    sum0 = hn::Add(sum0, hn::Mul(weight, hn::LoadU(d, rows)));
    if constexpr (Vectors == 2)
    {
      sum1 = hn::Add(sum1, hn::Mul(weight, hn::LoadU(d, rows + lanes)));
    }
  }
  hn::StoreU(sum0, d, sum + first);
  if constexpr (Vectors == 2)
  {
    hn::StoreU(sum1, d, sum + first + lanes);
  }
}

void sumAll(const double* const* columns, const double* weights, std::size_t count, double* sum,
  std::size_t rows)
{
  const hn::ScalableTag<double> d;
  const hn::CappedTag<double, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t first = 0;
  for (; first + 2 * lanes <= rows; first += 2 * lanes)
  {
    sumRows<2>(d, columns, weights, count, sum, first);
  }
  for (; first + lanes <= rows; first += lanes)
  {
    sumRows<1>(d, columns, weights, count, sum, first);
  }
  for (; first < rows; ++first)
  {
    sumRows<1>(one, columns, weights, count, sum, first);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(sumAll);

void weightedColumnSum(const double* const* columns, const double* weights, std::size_t count,
  double* sum, std::size_t rows) noexcept
{
  HWY_DYNAMIC_DISPATCH(sumAll)(columns, weights, count, sum, rows);
}

} // namespace msi
#endif

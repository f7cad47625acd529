#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Camera/Effects/SaturationKernel.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Camera/Effects/SaturationKernel.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE void saturateOne(D d, float level, float width2, float* values)
{
  const auto u = hn::LoadU(d, values);
  const auto corner = hn::Set(d, level);
  const auto beyond = hn::Sub(u, corner);
  const auto root = hn::Sqrt(hn::Add(hn::Mul(beyond, beyond), hn::Set(d, width2)));
  hn::StoreU(hn::Mul(hn::Set(d, 0.5F), hn::Sub(hn::Add(u, corner), root)), d, values);
}

void saturateAll(float level, float width2, float* values, std::size_t count)
{
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    saturateOne(d, level, width2, values + i);
  }
  for (; i < count; ++i)
  {
    saturateOne(one, level, width2, values + i);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(saturateAll);

void saturate(float level, float width2, float* values, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(saturateAll)(level, width2, values, count);
}

} // namespace msi
#endif

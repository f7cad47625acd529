#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Camera/Imaging/WeightedSum.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Camera/Imaging/WeightedSum.h"

#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// What one vector of weights is: the same for all values, or as they lie in memory.
template <bool Same, class D>
HWY_INLINE hn::Vec<D> weightsAt(D d, const float* weights)
{
  if constexpr (Same)
  {
    return hn::Set(d, *weights);
  }
  else
  {
    return hn::LoadU(d, weights);
  }
}

template <bool Same, class D>
HWY_INLINE void sumOne(D d, const float* weight, std::size_t step, const float* self,
  const float* const* before, const float* const* after, std::size_t taps, std::size_t place,
  float* out)
{
  auto sum = hn::Mul(weightsAt<Same>(d, weight), hn::LoadU(d, self + place));
  for (std::size_t tap = 1; tap < taps; ++tap)
  {
    const auto both = hn::Add(hn::LoadU(d, before[tap] + place), hn::LoadU(d, after[tap] + place));
    sum = hn::Add(sum, hn::Mul(weightsAt<Same>(d, weight + tap * step), both));
  }
  hn::StoreU(sum, d, out + place);
}

template <bool Same>
HWY_INLINE void sumRun(const float* weights, std::size_t period, const float* self,
  const float* const* before, const float* const* after, std::size_t taps, float* out,
  std::size_t first, std::size_t end)
{
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = first;
  for (; i + lanes <= end; i += lanes)
  {
    sumOne<Same>(d, weights + (Same ? 0 : i - first), period, self, before, after, taps, i, out);
  }
  for (; i < end; ++i)
  {
    sumOne<Same>(one, weights + (Same ? 0 : i - first), period, self, before, after, taps, i, out);
  }
}

void sumTaps(const float* weights, std::size_t period, const float* self,
  const float* const* before, const float* const* after, std::size_t taps, float* out,
  std::size_t count)
{
  if (period == 1)
  {
    sumRun<true>(weights, period, self, before, after, taps, out, 0, count);
    return;
  }
  for (std::size_t first = 0; first < count; first += period)
  {
    sumRun<false>(
      weights, period, self, before, after, taps, out, first, std::min(first + period, count));
  }
}

template <class D>
HWY_INLINE void weighOne(D d, const float* weight, std::size_t step, const float* const* sources,
  std::size_t taps, std::size_t place, float* out)
{
  auto sum = hn::Mul(hn::LoadU(d, weight), hn::LoadU(d, sources[0] + place));
  for (std::size_t tap = 1; tap < taps; ++tap)
  {
    sum =
      hn::Add(sum, hn::Mul(hn::LoadU(d, weight + tap * step), hn::LoadU(d, sources[tap] + place)));
  }
  hn::StoreU(sum, d, out + place);
}

void weigh(const float* weights, std::size_t step, std::size_t period, const float* const* sources,
  std::size_t taps, float* out, std::size_t count)
{
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t first = 0; first < count; first += period)
  {
    const std::size_t end = std::min(period, count - first);
    std::size_t i = 0;
    for (; i + lanes <= end; i += lanes)
    {
      weighOne(d, weights + i, step, sources, taps, first + i, out);
    }
    for (; i < end; ++i)
    {
      weighOne(one, weights + i, step, sources, taps, first + i, out);
    }
  }
}

void addTo(float weight, const float* values, float* sum, std::size_t count)
{
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto factor = hn::Set(d, weight);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    hn::StoreU(
      hn::Add(hn::LoadU(d, sum + i), hn::Mul(factor, hn::LoadU(d, values + i))), d, sum + i);
  }
  for (; i < count; ++i)
  {
    sum[i] += weight * values[i];
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(sumTaps);
HWY_EXPORT(weigh);
HWY_EXPORT(addTo);

void symmetricSum(const float* weights, std::size_t period, const float* self,
  const float* const* before, const float* const* after, std::size_t taps, float* out,
  std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(sumTaps)(weights, period, self, before, after, taps, out, count);
}

void weightedSum(const float* weights, std::size_t step, std::size_t period,
  const float* const* sources, std::size_t taps, float* out, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(weigh)(weights, step, period, sources, taps, out, count);
}

void addScaled(float weight, const float* values, float* sum, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(addTo)(weight, values, sum, count);
}

} // namespace msi
#endif

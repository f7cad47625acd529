#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Camera/CameraNoiseKernel.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Camera/CameraNoiseKernel.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE void addNoiseTo(D d, const NoiseTerms& terms, std::size_t i, float* values)
{
  auto u = hn::LoadU(d, values + i);
  if (terms.gainPattern != nullptr)
  {
    const auto pattern = hn::Mul(hn::Set(d, terms.gain), hn::LoadU(d, terms.gainPattern + i));
    u = hn::Mul(u, hn::Add(hn::Set(d, 1.0F), pattern));
  }
  if (terms.offsetPattern != nullptr)
  {
    u = hn::Add(u, hn::Mul(hn::Set(d, terms.offset), hn::LoadU(d, terms.offsetPattern + i)));
  }
  if (terms.temporal != nullptr)
  {
    const auto light = hn::IfThenElseZero(hn::Gt(u, hn::Zero(d)), u);
    auto deviation = hn::Sqrt(
      hn::Add(hn::Set(d, terms.readVariance), hn::Mul(hn::Set(d, terms.shotVariance), light)));
    if (terms.factor != nullptr)
    {
      deviation = hn::Mul(hn::LoadU(d, terms.factor + i), deviation);
    }
    u = hn::Add(u, hn::Mul(deviation, hn::LoadU(d, terms.temporal + i)));
  }
  if (terms.step > 0.0F)
  {
    // The nearest whole number, halves to even; larger values than a mantissa holds are whole already.
    const auto shift = hn::Set(d, 0x1.8p23F);
    const auto steps = hn::Div(u, hn::Set(d, terms.step));
    const auto small = hn::Lt(hn::Abs(steps), hn::Set(d, 0x1.8p21F));
    const auto whole = hn::IfThenElse(small, hn::Sub(hn::Add(steps, shift), shift), steps);
    u = hn::Mul(hn::Set(d, terms.step), whole);
  }
  hn::StoreU(u, d, values + i);
}

void addTerms(const NoiseTerms& terms, float* values, std::size_t count)
{
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    addNoiseTo(d, terms, i, values);
  }
  for (; i < count; ++i)
  {
    addNoiseTo(one, terms, i, values);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(addTerms);

void addNoise(const NoiseTerms& terms, float* values, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(addTerms)(terms, values, count);
}

} // namespace msi
#endif

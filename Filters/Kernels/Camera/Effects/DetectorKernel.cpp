#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Camera/Effects/DetectorKernel.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Camera/Effects/DetectorKernel.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// x^exponent for x > 0, up to e^700.
template <class D, class V>
HWY_INLINE V power(D d, V x, double exponent)
{
  const auto logarithm = hn::Mul(hn::Set(d, exponent), hn::Log(d, x));
  return hn::Exp(d, hn::Min(logarithm, hn::Set(d, 700.0)));
}

// Calls step(d, values) for all, a vector at a time and one by one at the end.
template <typename T, typename Step>
HWY_INLINE void forAll(T* values, std::size_t count, const Step& step)
{
  const hn::ScalableTag<T> d;
  const hn::CappedTag<T, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    step(d, values + i);
  }
  for (; i < count; ++i)
  {
    step(one, values + i);
  }
}

void raiseAll(double exponent, double* values, std::size_t count)
{
  forAll(values, count,
    [exponent](auto d, double* place) HWY_ATTR
    {
      const auto u = hn::LoadU(d, place);
      const auto positive = hn::Gt(u, hn::Zero(d));
      const auto safe = hn::IfThenElse(positive, u, hn::Set(d, 1.0));
      hn::StoreU(hn::IfThenElse(positive, power(d, safe, exponent), u), d, place);
    });
}

void saturateAllGradually(double level, double sharpness, double* values, std::size_t count)
{
  forAll(values, count,
    [level, sharpness](auto d, double* place) HWY_ATTR
    {
      const auto u = hn::LoadU(d, place);
      const auto one = hn::Set(d, 1.0);
      const auto positive = hn::Gt(u, hn::Zero(d));
      const auto relative = hn::IfThenElse(positive, hn::Div(u, hn::Set(d, level)), one);
      const auto over = hn::Add(one, power(d, relative, sharpness));
      const auto saturated = hn::Mul(u, power(d, over, -1.0 / sharpness));
      hn::StoreU(hn::IfThenElse(positive, saturated, u), d, place);
    });
}

void saturateAll(float level, float width2, float* values, std::size_t count)
{
  forAll(values, count,
    [level, width2](auto d, float* place) HWY_ATTR
    {
      const auto u = hn::LoadU(d, place);
      const auto corner = hn::Set(d, level);
      const auto beyond = hn::Sub(u, corner);
      const auto root = hn::Sqrt(hn::Add(hn::Mul(beyond, beyond), hn::Set(d, width2)));
      hn::StoreU(hn::Mul(hn::Set(d, 0.5F), hn::Sub(hn::Add(u, corner), root)), d, place);
    });
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(raiseAll);
HWY_EXPORT(saturateAllGradually);
HWY_EXPORT(saturateAll);

void raise(double exponent, double* values, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(raiseAll)(exponent, values, count);
}

void saturateGradually(double level, double sharpness, double* values, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(saturateAllGradually)(level, sharpness, values, count);
}

void saturate(float level, float width2, float* values, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(saturateAll)(level, width2, values, count);
}

} // namespace msi
#endif

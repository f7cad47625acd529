#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Camera/Effects/PowerKernel.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Camera/Effects/PowerKernel.h"

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

template <class D>
HWY_INLINE void raiseOne(D d, double exponent, double* values)
{
  const auto u = hn::LoadU(d, values);
  const auto positive = hn::Gt(u, hn::Zero(d));
  const auto safe = hn::IfThenElse(positive, u, hn::Set(d, 1.0));
  hn::StoreU(hn::IfThenElse(positive, power(d, safe, exponent), u), d, values);
}

template <class D>
HWY_INLINE void saturateOne(D d, double level, double sharpness, double* values)
{
  const auto u = hn::LoadU(d, values);
  const auto one = hn::Set(d, 1.0);
  const auto positive = hn::Gt(u, hn::Zero(d));
  const auto relative = hn::IfThenElse(positive, hn::Div(u, hn::Set(d, level)), one);
  const auto over = hn::Add(one, power(d, relative, sharpness));
  const auto saturated = hn::Mul(u, power(d, over, -1.0 / sharpness));
  hn::StoreU(hn::IfThenElse(positive, saturated, u), d, values);
}

void raiseAll(double exponent, double* values, std::size_t count)
{
  const hn::ScalableTag<double> d;
  const hn::CappedTag<double, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    raiseOne(d, exponent, values + i);
  }
  for (; i < count; ++i)
  {
    raiseOne(one, exponent, values + i);
  }
}

void saturateAllGradually(double level, double sharpness, double* values, std::size_t count)
{
  const hn::ScalableTag<double> d;
  const hn::CappedTag<double, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    saturateOne(d, level, sharpness, values + i);
  }
  for (; i < count; ++i)
  {
    saturateOne(one, level, sharpness, values + i);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(raiseAll);
HWY_EXPORT(saturateAllGradually);

void raise(double exponent, double* values, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(raiseAll)(exponent, values, count);
}

void saturateGradually(double level, double sharpness, double* values, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(saturateAllGradually)(level, sharpness, values, count);
}

} // namespace msi
#endif

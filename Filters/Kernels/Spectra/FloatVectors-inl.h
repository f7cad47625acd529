// Vectors of single precision, rounded in one way on every instruction set. Included once for each of them by Highway's
// foreach_target.h.
#if defined(MULTISPECTRAL_FLOAT_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MULTISPECTRAL_FLOAT_VECTORS_INL_H
#undef MULTISPECTRAL_FLOAT_VECTORS_INL_H
#else
#define MULTISPECTRAL_FLOAT_VECTORS_INL_H
#endif

#include "Kernels/Spectra/FusedMultiply-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

using FloatsTag = hn::CappedTag<float, 16>;
using FloatsVector = hn::Vec<FloatsTag>;
using FloatsMask = hn::Mask<FloatsTag>;
constexpr std::size_t MostFloats = hn::MaxLanes(FloatsTag());

HWY_INLINE FloatsVector constant(double value)
{
  return hn::Set(FloatsTag(), static_cast<float>(value));
}

// a x + b
HWY_INLINE FloatsVector fused(FloatsVector a, FloatsVector x, FloatsVector b)
{
  return fusedMultiplyAdd(FloatsTag(), a, x, b);
}

HWY_INLINE FloatsVector squared(FloatsVector x)
{
  return x * x;
}

// Coefficients from the highest power down.
template <std::size_t Count>
HWY_INLINE FloatsVector polynomialOf(FloatsVector x, const std::array<double, Count>& coefficients)
{
  FloatsVector result = constant(coefficients[0]);
  for (std::size_t i = 1; i < Count; ++i)
  {
    result = fused(result, x, constant(coefficients[i]));
  }
  return result;
}

// One color a lane.
struct FloatColors
{
  FloatsVector first, second, third;
};

HWY_INLINE FloatColors loadFloatColors(const float* from)
{
  FloatColors colors;
  hn::LoadInterleaved3(FloatsTag(), from, colors.first, colors.second, colors.third);
  return colors;
}

HWY_INLINE void storeFloatColors(const FloatColors& colors, float* to)
{
  hn::StoreInterleaved3(colors.first, colors.second, colors.third, FloatsTag(), to);
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#endif

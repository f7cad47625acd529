// CIELAB of vectors of colors in single precision. Included once for each instruction set by Highway's foreach_target.h.
#if defined(MULTISPECTRAL_CIELAB_FLOAT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MULTISPECTRAL_CIELAB_FLOAT_INL_H
#undef MULTISPECTRAL_CIELAB_FLOAT_INL_H
#else
#define MULTISPECTRAL_CIELAB_FLOAT_INL_H
#endif

#include "Kernels/Spectra/FloatVectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

// The inverse cube root of x from its exponent, off by 3.5 %.
HWY_INLINE FloatsVector inverseCubeRootGuess(FloatsVector x)
{
  const FloatsTag d;
  const hn::RebindToSigned<FloatsTag> integers;
  const auto exponent = hn::ConvertTo(d, hn::BitCast(integers, x));
  const auto bits =
    fusedMultiplyAdd(d, exponent, hn::Set(d, -1.0F / 3.0F), hn::Set(d, 1419909090.0F));
  return hn::BitCast(d, hn::ConvertTo(integers, bits));
}

// The cube root of x within 1e-30..1e30 to 1e-7; of anything else, anything. The guess, four terms of its series to 1.7e-5,
// then a step of Newton's method for the root itself.
HWY_INLINE FloatsVector cubeRootOf(FloatsVector x)
{
  const FloatsVector guess = inverseCubeRootGuess(x);
  const FloatsVector remainder = fused(hn::Neg(x * guess), squared(guess), constant(1.0));
  const FloatsVector series = remainder *
    fused(
      remainder, fused(remainder, constant(14.0 / 81.0), constant(2.0 / 9.0)), constant(1.0 / 3.0));
  const FloatsVector inverse = fused(guess, series, guess);
  const FloatsVector square = squared(inverse);
  const FloatsVector root = x * square;
  const FloatsVector excess = fused(squared(root), root, hn::Neg(x));
  return fused(excess, square * constant(-1.0 / 3.0), root);
}

HWY_INLINE FloatsVector compressed(FloatsVector ratio)
{
  const FloatsVector linear = fused(ratio, constant(841.0 / 108.0), constant(4.0 / 29.0));
  return hn::IfThenElse(hn::Gt(ratio, constant(216.0 / 24389.0)), cubeRootOf(ratio), linear);
}

// L*, a* and b*.
HWY_INLINE FloatColors labOf(const double* whitePoint, const FloatColors& xyz)
{
  const FloatsVector x = compressed(xyz.first * constant(1.0 / whitePoint[0]));
  const FloatsVector y = compressed(xyz.second * constant(1.0 / whitePoint[1]));
  const FloatsVector z = compressed(xyz.third * constant(1.0 / whitePoint[2]));
  return { fused(constant(116.0), y, constant(-16.0)), constant(500.0) * (x - y),
    constant(200.0) * (y - z) };
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#endif

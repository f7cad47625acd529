// a x + b of single precision, rounded once on every instruction set. Included once for each of them by Highway's
// foreach_target.h.
#if defined(MULTISPECTRAL_FUSED_MULTIPLY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MULTISPECTRAL_FUSED_MULTIPLY_INL_H
#undef MULTISPECTRAL_FUSED_MULTIPLY_INL_H
#else
#define MULTISPECTRAL_FUSED_MULTIPLY_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

#if HWY_NATIVE_FMA

template <class Tag, class Floats>
HWY_INLINE Floats fusedMultiplyAdd(Tag, Floats a, Floats x, Floats b)
{
  return hwy::HWY_NAMESPACE::MulAdd(a, x, b);
}

#elif HWY_TARGET == HWY_SCALAR

template <class Tag, class Floats>
HWY_INLINE Floats fusedMultiplyAdd(Tag d, Floats a, Floats x, Floats b)
{
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Set(d, std::fma(hn::GetLane(a), hn::GetLane(x), hn::GetLane(b)));
}

#else

// In double the product is exact. The sum is rounded to odd: to the neighbour with an odd last digit, where it is not
// exact. Rounded again, to float, it is what one rounding gives (Boldo and Melquiond, 2008, doi 10.1109/TC.2007.70819).
template <class DoubleTag, class Doubles>
HWY_INLINE Doubles sumToOdd(DoubleTag d, Doubles a, Doubles b)
{
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<DoubleTag> integers;
  const auto sum = hn::Add(a, b);
  const auto shareOfB = hn::Sub(sum, a);
  const auto error = hn::Add(hn::Sub(a, hn::Sub(sum, shareOfB)), hn::Sub(b, shareOfB));
  const auto bits = hn::BitCast(integers, sum);
  const auto one = hn::Set(integers, 1);
  // One unit of the last place away from zero, or towards it, as the error has the sum's sign.
  const auto step = hn::Or(hn::BroadcastSignBit(hn::Xor(bits, hn::BitCast(integers, error))), one);
  const auto isEven = hn::Eq(hn::And(bits, one), hn::Zero(integers));
  const auto isInexact = hn::RebindMask(integers, hn::Gt(hn::Abs(error), hn::Zero(d)));
  return hn::BitCast(d, hn::Add(bits, hn::IfThenElseZero(hn::And(isInexact, isEven), step)));
}

template <class Tag, class Floats>
HWY_INLINE Floats fusedMultiplyAdd(Tag d, Floats a, Floats x, Floats b)
{
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Half<Tag> half;
  const hn::Rebind<double, hn::Half<Tag>> wide;
  const auto run = [&](auto aHalf, auto xHalf, auto bHalf) HWY_ATTR
  {
    const auto product = hn::Mul(hn::PromoteTo(wide, aHalf), hn::PromoteTo(wide, xHalf));
    const auto sum = sumToOdd(wide, product, hn::PromoteTo(wide, bHalf));
    // DemoteTo may stop at the largest float: adding it once more gives infinity. A zero of the sum's sign changes nothing.
    const auto overflows = hn::Ge(hn::Abs(sum), hn::Set(wide, 0x1.ffffffp127));
    const auto more = hn::CopySign(hn::IfThenElseZero(overflows, hn::Set(wide, 1.0)), sum);
    return hn::Add(
      hn::DemoteTo(half, sum), hn::Mul(hn::DemoteTo(half, more), hn::Set(half, 0x1.fffffep127F)));
  };
  return hn::Combine(d, run(hn::UpperHalf(half, a), hn::UpperHalf(half, x), hn::UpperHalf(half, b)),
    run(hn::LowerHalf(half, a), hn::LowerHalf(half, x), hn::LowerHalf(half, b)));
}

#endif

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#endif

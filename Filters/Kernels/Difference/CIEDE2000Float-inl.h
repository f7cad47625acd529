// CIEDE2000 of vectors of pairs in single precision, in three steps. Included once for each instruction set by Highway's
// foreach_target.h.
#if defined(MULTISPECTRAL_CIEDE2000_FLOAT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MULTISPECTRAL_CIEDE2000_FLOAT_INL_H
#undef MULTISPECTRAL_CIEDE2000_FLOAT_INL_H
#else
#define MULTISPECTRAL_CIEDE2000_FLOAT_INL_H
#endif

#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Spectra/FloatVectors-inl.h"

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

// The formula of CIEDE2000Blocks.cpp in single precision, twice as many pairs a vector. What would lose digits there is
// written otherwise: differences of chroma and hue come from differences of coordinates, which are exact for colors that
// are close. Where a rounding could take one hue for the other side of its opposite, and for coordinates whose squares
// could overflow, the pair is to be computed in double.
//
// Each operation of the formula waits for the one before it. So it is cut into three steps, and each step is run on all
// vectors of a block: the processor works on several vectors at once.

constexpr std::size_t BlockOfPairs = 128;

// What one step leaves for the next.
struct PairBlock
{
  using Values = std::array<float, BlockOfPairs>;
  Values deltaL, weightL, a1, b1, a2, b2, apartA;            // of the first step
  Values deltaC, deltaH, cosine, sine, chromaSum, uncertain; // of the second, the last of both
};

struct FloatFactors
{
  explicit FloatFactors(const CIEDE2000Factors& factors)
    : perL(static_cast<float>(1.0 / factors.kL))
    , perC(static_cast<float>(1.0 / factors.kC))
    , perH(static_cast<float>(1.4142135623730950 / factors.kH))
  {
  }

  float perL;
  float perC;
  float perH; // times the root of 2
};

// Pairs whose coordinates' squares add up to more are computed in double.
constexpr float LargestSquare = 1e8F;
// Sines of the angle between opposite hues below this may have the other sign.
constexpr double SideTolerance = 1e-6;

// exp(-(d / 25 degrees)^2 / 4) in the square of the chord of the angle d, up to 95 degrees; its fourth power is within
// 5e-8. Minimax fit, as the next one.
constexpr std::array<double, 7> GaussianRoot{ 0.0005054152205720974, -0.00702451946301227,
  0.052006387992294664, -0.24813294378672235, 0.7526953202366954, -1.3131211849016131,
  0.9999999885635349 };
// 2 sin(60 degrees x) / x in x^2, for x within 0..1, within 4e-8.
constexpr std::array<double, 4> SineRatio{ 2.0 * -0.00026476833428184843, 2.0 * 0.01048760969667377,
  2.0 * -0.19139486212375184, 2.0 * 1.0471974086636149 };
// The factors of cos and sin of h, 3h and 4h in T.
constexpr std::array<double, 2> One{ -0.17 * 0.86602540378443865, -0.17 * 0.5 };
constexpr std::array<double, 2> Three{ 0.32 * 0.99452189536827333, -0.32 * 0.10452846326765347 };
constexpr std::array<double, 2> Four{ -0.20 * 0.45399049973954680, -0.20 * 0.89100652418836786 };

// At 0, where a factor of 0 follows, something finite.
HWY_INLINE FloatsVector inverseRootOf(FloatsVector x)
{
  return constant(1.0) / hn::Sqrt(hn::Max(x, constant(1e-37)));
}

// sqrt(C^7 / (C^7 + 25^7)) of half the sum; the bound keeps C^14 finite and changes no digit.
HWY_INLINE FloatsVector saturationOf(FloatsVector chromaSum)
{
  const FloatsVector ratio = hn::Min(chromaSum * constant(0.5 / 25.0), constant(100.0));
  const FloatsVector seventh = squared(squared(ratio) * ratio) * ratio;
  return seventh * inverseRootOf(fused(seventh, seventh, seventh));
}

// Lightness, and a* stretched by 1 + G.
HWY_INLINE void stretchPairs(const FloatFactors& factors, const FloatColors& lab1,
  const FloatColors& lab2, PairBlock& block, std::size_t at)
{
  const FloatsTag d;
  const FloatsVector middle =
    squared(fused(constant(0.5), lab1.first + lab2.first, constant(-50.0)));
  const FloatsVector root = hn::Sqrt(constant(20.0) + middle);
  // Both times the root that S_L is divided by.
  hn::StoreU(hn::Set(d, factors.perL) * (lab2.first - lab1.first) * root, d, &block.deltaL[at]);
  hn::StoreU(fused(constant(0.015), middle, root), d, &block.weightL[at]);

  const FloatsVector square1 = fused(lab1.second, lab1.second, squared(lab1.third));
  const FloatsVector square2 = fused(lab2.second, lab2.second, squared(lab2.third));
  const FloatsVector stretch =
    fused(constant(-0.5), saturationOf(hn::Sqrt(square1) + hn::Sqrt(square2)), constant(1.5));
  hn::StoreU(stretch * lab1.second, d, &block.a1[at]);
  hn::StoreU(lab1.third, d, &block.b1[at]);
  hn::StoreU(stretch * lab2.second, d, &block.a2[at]);
  hn::StoreU(lab2.third, d, &block.b2[at]);
  hn::StoreU(stretch * (lab2.second - lab1.second), d, &block.apartA[at]);
  hn::StoreU(fused(lab1.first, lab1.first, square1) + fused(lab2.first, lab2.first, square2), d,
    &block.uncertain[at]);
}

// The differences of chroma and hue, and the direction of the mean hue.
HWY_INLINE void turnPairs(const FloatFactors& factors, PairBlock& block, std::size_t at)
{
  const FloatsTag d;
  const FloatsVector zero = hn::Zero(d);
  const FloatsVector a1 = hn::LoadU(d, &block.a1[at]);
  const FloatsVector b1 = hn::LoadU(d, &block.b1[at]);
  const FloatsVector a2 = hn::LoadU(d, &block.a2[at]);
  const FloatsVector b2 = hn::LoadU(d, &block.b2[at]);
  const FloatsVector apartA = hn::LoadU(d, &block.apartA[at]);
  const FloatsVector apartB = b2 - b1;
  const FloatsVector square1 = fused(a1, a1, squared(b1));
  const FloatsVector square2 = fused(a2, a2, squared(b2));
  const FloatsVector inverse1 = inverseRootOf(square1);
  const FloatsVector inverse2 = inverseRootOf(square2);
  const FloatsVector chroma1 = square1 * inverse1;
  const FloatsVector chroma2 = square2 * inverse2;
  const FloatsVector chromaSum = chroma1 + chroma2;
  const FloatsVector product = chroma1 * chroma2;
  hn::StoreU(chromaSum, d, &block.chromaSum[at]);

  // C2^2 - C1^2 over C2 + C1
  const FloatsVector squares = fused(apartA, a1 + a2, apartB * (b1 + b2));
  const FloatsVector deltaC = hn::IfThenZeroElse(hn::Eq(chromaSum, zero), squares / chromaSum);
  hn::StoreU(hn::Set(d, factors.perC) * deltaC, d, &block.deltaC[at]);

  // 2 (C1 C2 - dot) is cross^2 over half of C1 C2 + dot, and that has no cancellation for hues within 90 degrees. When the
  // colors change places, cross changes its sign and no digit.
  const FloatsVector dot = fused(a1, a2, b1 * b2);
  const FloatsMask wide = hn::Lt(dot, zero);
  const FloatsVector cross = constant(0.5) * ((a1 + a2) * apartB - (b1 + b2) * apartA);
  const FloatsVector turns = a1 * b2 - a2 * b1;
  const FloatsVector both = product + hn::Abs(dot);
  const FloatsVector across = hn::IfThenElse(wide, hn::CopySign(both, turns), cross);
  const FloatsVector deltaH = hn::IfThenZeroElse(
    hn::Eq(product, zero), across * hn::Set(d, factors.perH) * inverseRootOf(both));
  hn::StoreU(deltaH, d, &block.deltaH[at]);

  // The mean hue: along the sum of both directions, or across their difference where they are apart by more than 90
  // degrees. A neutral color has no direction.
  const FloatsVector x1 = a1 * inverse1;
  const FloatsVector y1 = b1 * inverse1;
  const FloatsVector x2 = a2 * inverse2;
  const FloatsVector y2 = b2 * inverse2;
  const FloatsVector sign = hn::And(turns, hn::SignBit(d));
  const FloatsVector meanX = hn::IfThenElse(wide, hn::Xor(sign, y2 - y1), x1 + x2);
  const FloatsVector meanY = hn::IfThenElse(wide, hn::Xor(sign, x1 - x2), y1 + y2);
  const FloatsVector inverse = inverseRootOf(fused(meanX, meanX, squared(meanY)));
  hn::StoreU(meanX * inverse, d, &block.cosine[at]);
  hn::StoreU(meanY * inverse, d, &block.sine[at]);

  const FloatsMask opposite =
    hn::And(wide, hn::Le(hn::Abs(turns), product * constant(SideTolerance)));
  const FloatsVector uncertain = hn::LoadU(d, &block.uncertain[at]);
  hn::StoreU(
    hn::IfThenElse(opposite, constant(2.0F * LargestSquare), uncertain), d, &block.uncertain[at]);
}

// The weights, the rotation and the sum, with one denominator.
HWY_INLINE FloatsVector sumOfPairs(const PairBlock& block, std::size_t at)
{
  const FloatsTag d;
  const FloatsVector c1 = hn::LoadU(d, &block.cosine[at]);
  const FloatsVector s1 = hn::LoadU(d, &block.sine[at]);

  // T, by the cosines and sines of the multiple angles
  const FloatsVector c2 = fused(c1, c1, hn::Neg(squared(s1)));
  const FloatsVector s2 = (c1 + c1) * s1;
  const FloatsVector ofC1 =
    fused(c2, constant(Three[0]), fused(s2, constant(Three[1]), constant(One[0])));
  const FloatsVector ofS1 =
    fused(s2, constant(-Three[0]), fused(c2, constant(Three[1]), constant(One[1])));
  const FloatsVector ofC2 =
    fused(c2, constant(2.0 * Four[0]), fused(s2, constant(2.0 * Four[1]), constant(0.24)));
  const FloatsVector hueWeight =
    fused(c1, ofC1, fused(s1, ofS1, fused(c2, ofC2, constant(1.0 - Four[0]))));

  // -R_T. Mean hues of 0 to 180 degrees are far from 275: the term is below 1e-6 there.
  const FloatsVector chromaSum = hn::LoadU(d, &block.chromaSum[at]);
  const FloatsVector fromX = c1 - constant(0.087155742747658174);
  const FloatsVector fromY = s1 + constant(0.99619469809174553);
  const FloatsVector chord2 = fused(fromX, fromX, squared(fromY));
  const FloatsVector gaussian = squared(squared(polynomialOf(chord2, GaussianRoot)));
  const FloatsVector sine = gaussian * polynomialOf(squared(gaussian), SineRatio);
  const FloatsVector rotate =
    hn::IfThenZeroElse(hn::Ge(s1, hn::Zero(d)), saturationOf(chromaSum) * sine);

  const FloatsVector weightL = hn::LoadU(d, &block.weightL[at]);
  const FloatsVector weightC = fused(constant(0.0225), chromaSum, constant(1.0));
  const FloatsVector weightH = fused(constant(0.0075) * chromaSum, hueWeight, constant(1.0));
  const FloatsVector weightCH = weightC * weightH;
  const FloatsVector l = hn::LoadU(d, &block.deltaL[at]) * weightCH;
  const FloatsVector c = hn::LoadU(d, &block.deltaC[at]) * (weightL * weightH);
  const FloatsVector h = hn::LoadU(d, &block.deltaH[at]) * (weightL * weightC);
  const FloatsVector sum = fused(h, h, fused(c, c, squared(l))) - rotate * (c * h);
  return hn::Sqrt(sum) / (weightL * weightCH);
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#endif

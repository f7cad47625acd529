#include "Kernels/Difference/CIEDE2000Blocks.h"

#include <algorithm>
#include <array>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Difference/CIEDE2000FloatBlocks.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace
{
namespace hn = hwy::HWY_NAMESPACE;

// The formula of CIEDE2000Blocks.cpp in single precision, twice as many pairs a vector. What would lose digits there is
// written otherwise: differences of chroma and hue come from differences of coordinates, which are exact for colors that
// are close. Where a rounding could take one hue for the other side of its opposite, and for coordinates whose squares
// could overflow, the pair is computed in double. Additions, multiplications, divisions and square roots alone: every
// instruction set gives the same bytes.
using Tag = hn::ScalableTag<float>;
using Float = hn::Vec<Tag>;
using FloatMask = hn::Mask<Tag>;
constexpr std::size_t MostFloats = hn::MaxLanes(Tag());

// Coordinates beyond this are computed in double.
constexpr double LargestCoordinate = 1e4;
// Products that differ by less than this part of their sizes may be the other way round.
constexpr double SideTolerance = 1e-6;

Float constant(double value)
{
  return hn::Set(Tag(), static_cast<float>(value));
}

Float squared(Float x)
{
  return hn::Mul(x, x);
}

Float lengthOf(Float x, Float y)
{
  return hn::Sqrt(hn::Add(squared(x), squared(y)));
}

template <std::size_t Count>
Float polynomialOf(Float x, const std::array<double, Count>& coefficients)
{
  Float result = constant(coefficients[0]);
  for (std::size_t i = 1; i < Count; ++i)
  {
    result = hn::Add(hn::Mul(result, x), constant(coefficients[i]));
  }
  return result;
}

struct Pairs
{
  Float L1, a1, b1, L2, a2, b2;
};

Pairs loadPairs(const float* lab1, const float* lab2)
{
  Pairs p;
  hn::LoadInterleaved3(Tag(), lab1, p.L1, p.a1, p.b1);
  hn::LoadInterleaved3(Tag(), lab2, p.L2, p.a2, p.b2);
  return p;
}

// sqrt(C^7 / (C^7 + 25^7)); the bound keeps C^7 finite and changes no digit.
Float saturationOf(Float chroma)
{
  const Float ratio = hn::Min(hn::Mul(chroma, constant(1.0 / 25.0)), constant(1e4));
  const Float cube = hn::Mul(squared(ratio), ratio);
  const Float seventh = hn::Mul(squared(cube), ratio);
  return hn::Sqrt(hn::Div(seventh, hn::Add(seventh, constant(1.0))));
}

// T, by the cosines and sines of the multiple angles.
Float hueWeightOf(Float c1, Float s1)
{
  const Float c2 = hn::Sub(squared(c1), squared(s1));
  const Float s2 = hn::Mul(hn::Add(c1, c1), s1);
  const Float c3 = hn::Sub(hn::Mul(c2, c1), hn::Mul(s2, s1));
  const Float s3 = hn::Add(hn::Mul(s2, c1), hn::Mul(c2, s1));
  const Float c4 = hn::Sub(squared(c2), squared(s2));
  const Float s4 = hn::Mul(hn::Add(c2, c2), s2);
  Float weight = constant(1.0);
  weight = hn::Sub(weight, hn::Mul(constant(0.17 * 0.86602540378443865), c1));
  weight = hn::Sub(weight, hn::Mul(constant(0.17 * 0.5), s1));
  weight = hn::Add(weight, hn::Mul(constant(0.24), c2));
  weight = hn::Add(weight, hn::Mul(constant(0.32 * 0.99452189536827333), c3));
  weight = hn::Sub(weight, hn::Mul(constant(0.32 * 0.10452846326765347), s3));
  weight = hn::Sub(weight, hn::Mul(constant(0.20 * 0.45399049973954680), c4));
  return hn::Sub(weight, hn::Mul(constant(0.20 * 0.89100652418836786), s4));
}

// As in CIEDE2000Blocks.cpp, of lower degree: exp(-(d / 25)^2) within 1e-8, sin(60 degrees x) / x within 4e-8.
constexpr std::array<double, 6> GaussianRoot{ -0.19083210622508467, 0.8220217568413218,
  -1.9844408210103452, 3.0108096895213827, -2.626244367900019, 0.9999999989753181 };
constexpr double GaussianEnd = 0.57738173825930056;
constexpr std::array<double, 4> SineRatio{ -0.00026578126191645053, 0.010489381995612087,
  -0.19139574798672368, 1.0471975193151297 };

Float rotationOf(Float cosine, Float sine)
{
  const Float toBlue = hn::Sub(
    hn::Mul(cosine, constant(0.087155742747658174)), hn::Mul(sine, constant(0.99619469809174553)));
  const Float fromBlue = hn::Add(
    hn::Mul(cosine, constant(0.99619469809174553)), hn::Mul(sine, constant(0.087155742747658174)));
  // 1 - cos d, from the sine where the cosine would lose digits; then 1 - cos(d / 2).
  const Float one = constant(1.0);
  const Float versine = hn::IfThenElse(hn::Gt(toBlue, hn::Zero(Tag())),
    hn::Div(squared(fromBlue), hn::Add(one, toBlue)), hn::Sub(one, toBlue));
  const Float half = hn::Mul(versine, constant(0.5));
  const Float halfCosine = hn::Sqrt(hn::Max(hn::Sub(one, half), hn::Zero(Tag())));
  const Float halfVersine = hn::Min(hn::Div(half, hn::Add(one, halfCosine)), constant(GaussianEnd));
  const Float gaussian =
    squared(squared(squared(squared(polynomialOf(halfVersine, GaussianRoot)))));
  return hn::Mul(gaussian, polynomialOf(squared(gaussian), SineRatio));
}

Float differenceOf(const CIEDE2000Factors& factors, const Pairs& p, FloatMask& inDouble)
{
  const Float zero = hn::Zero(Tag());
  const Float half = constant(0.5);
  const Float meanChroma = hn::Mul(half, hn::Add(lengthOf(p.a1, p.b1), lengthOf(p.a2, p.b2)));
  const Float stretch = hn::Sub(constant(1.5), hn::Mul(half, saturationOf(meanChroma)));
  const Float a1 = hn::Mul(stretch, p.a1);
  const Float a2 = hn::Mul(stretch, p.a2);
  const Float chroma1 = lengthOf(a1, p.b1);
  const Float chroma2 = lengthOf(a2, p.b2);
  const Float chromaSum = hn::Add(chroma1, chroma2);
  const Float apartA = hn::Mul(stretch, hn::Sub(p.a2, p.a1));
  const Float apartB = hn::Sub(p.b2, p.b1);

  // C2^2 - C1^2 over C2 + C1.
  const Float squares =
    hn::Add(hn::Mul(apartA, hn::Add(a1, a2)), hn::Mul(apartB, hn::Add(p.b1, p.b2)));
  const Float deltaC = hn::IfThenZeroElse(hn::Eq(chromaSum, zero), hn::Div(squares, chromaSum));

  // 2 (C1 C2 - dot) is cross^2 over half of C1 C2 + dot, and that has no cancellation for hues within 90 degrees.
  const Float dot = hn::Add(hn::Mul(a1, a2), hn::Mul(p.b1, p.b2));
  // From the mean of both, so that an exchange of the colors changes its sign and no digit.
  const Float cross =
    hn::Mul(half, hn::Sub(hn::Mul(hn::Add(a1, a2), apartB), hn::Mul(hn::Add(p.b1, p.b2), apartA)));
  const Float product = hn::Mul(chroma1, chroma2);
  const FloatMask wide = hn::Lt(dot, zero);
  const Float near = hn::Mul(cross, hn::Sqrt(hn::Div(constant(2.0), hn::Add(product, dot))));
  const Float far = hn::Sqrt(hn::Mul(constant(2.0), hn::Sub(product, dot)));
  const FloatMask forward = hn::Gt(cross, zero);
  const Float signedFar = hn::IfThenElse(forward, far, hn::Neg(far));
  const Float deltaH =
    hn::IfThenZeroElse(hn::Eq(product, zero), hn::IfThenElse(wide, signedFar, near));

  // The mean hue: along the sum of both directions, or across their difference where they are apart by more than 90
  // degrees. A neutral color has no direction.
  const Float inverse1 = hn::IfThenZeroElse(hn::Eq(chroma1, zero), hn::Div(constant(1.0), chroma1));
  const Float inverse2 = hn::IfThenZeroElse(hn::Eq(chroma2, zero), hn::Div(constant(1.0), chroma2));
  const Float x1 = hn::Mul(a1, inverse1);
  const Float y1 = hn::Mul(p.b1, inverse1);
  const Float x2 = hn::Mul(a2, inverse2);
  const Float y2 = hn::Mul(p.b2, inverse2);
  const Float turnedX = hn::IfThenElse(forward, hn::Sub(y2, y1), hn::Sub(y1, y2));
  const Float turnedY = hn::IfThenElse(forward, hn::Sub(x1, x2), hn::Sub(x2, x1));
  const Float meanX = hn::IfThenElse(wide, turnedX, hn::Add(x1, x2));
  const Float meanY = hn::IfThenElse(wide, turnedY, hn::Add(y1, y2));
  const Float size = lengthOf(meanX, meanY);
  const FloatMask neutral = hn::Eq(size, zero);
  const Float inverse = hn::IfThenZeroElse(neutral, hn::Div(constant(1.0), size));
  const Float cosine = hn::IfThenElse(neutral, constant(1.0), hn::Mul(meanX, inverse));
  const Float sine = hn::Mul(meanY, inverse);

  const Float meanPrimed = hn::Mul(half, chromaSum);
  const Float middle = squared(hn::Sub(hn::Mul(half, hn::Add(p.L1, p.L2)), constant(50.0)));
  const Float weightL = hn::Add(constant(1.0),
    hn::Div(hn::Mul(constant(0.015), middle), hn::Sqrt(hn::Add(constant(20.0), middle))));
  const Float weightC = hn::Add(constant(1.0), hn::Mul(constant(0.045), meanPrimed));
  const Float weightH = hn::Add(
    constant(1.0), hn::Mul(hn::Mul(constant(0.015), meanPrimed), hueWeightOf(cosine, sine)));
  // Mean hues of 0 to 60 degrees are far from 275; between those of 300 to 360 and these the term is below 1e-5.
  const FloatMask pastRed = hn::And(hn::Gt(cosine, half), hn::Ge(sine, zero));
  const Float rotate = hn::IfThenZeroElse(
    pastRed, hn::Mul(hn::Mul(constant(2.0), saturationOf(meanPrimed)), rotationOf(cosine, sine)));

  const Float l = hn::Div(hn::Sub(p.L2, p.L1), hn::Mul(constant(factors.kL), weightL));
  const Float c = hn::Div(deltaC, hn::Mul(constant(factors.kC), weightC));
  const Float h = hn::Div(deltaH, hn::Mul(constant(factors.kH), weightH));

  const Float turns = hn::Sub(hn::Mul(p.a1, p.b2), hn::Mul(p.a2, p.b1));
  const Float sizes = hn::Add(hn::Abs(hn::Mul(p.a1, p.b2)), hn::Abs(hn::Mul(p.a2, p.b1)));
  const FloatMask opposite =
    hn::And(wide, hn::Le(hn::Abs(turns), hn::Mul(sizes, constant(SideTolerance))));
  const Float largest =
    hn::Max(hn::Max(hn::Max(hn::Abs(p.a1), hn::Abs(p.a2)), hn::Max(hn::Abs(p.b1), hn::Abs(p.b2))),
      hn::Max(hn::Abs(p.L1), hn::Abs(p.L2)));
  inDouble = hn::Or(opposite, hn::Gt(largest, constant(LargestCoordinate)));
  return hn::Sqrt(
    hn::Sub(hn::Add(hn::Add(squared(l), squared(c)), squared(h)), hn::Mul(rotate, hn::Mul(c, h))));
}

void oneInDouble(
  const CIEDE2000Factors& factors, const float* lab1, const float* lab2, float* result)
{
  std::array<double, 3> first{};
  std::array<double, 3> second{};
  std::copy_n(lab1, 3, first.begin());
  std::copy_n(lab2, 3, second.begin());
  double difference = 0.0;
  differencesCIEDE2000<double>(factors, first.data(), second.data(), &difference, 1);
  *result = static_cast<float>(difference);
}

void oneGroup(const CIEDE2000Factors& factors, const float* lab1, const float* lab2, float* result)
{
  FloatMask inDouble;
  hn::StoreU(differenceOf(factors, loadPairs(lab1, lab2), inDouble), Tag(), result);
  if (hn::AllFalse(Tag(), inDouble))
  {
    return;
  }
  std::array<std::uint8_t, MostFloats / 8 + 8> bits{};
  hn::StoreMaskBits(Tag(), inDouble, bits.data());
  for (std::size_t i = 0; i < hn::Lanes(Tag()); ++i)
  {
    if ((bits[i / 8] >> (i % 8) & 1U) != 0)
    {
      oneInDouble(factors, lab1 + 3 * i, lab2 + 3 * i, result + i);
    }
  }
}
}

void differencesInFloat(const CIEDE2000Factors& factors, const float* lab1, const float* lab2,
  float* result, std::size_t count)
{
  const std::size_t lanes = hn::Lanes(Tag());
  std::size_t first = 0;
  for (; first + lanes <= count; first += lanes)
  {
    oneGroup(factors, lab1 + 3 * first, lab2 + 3 * first, result + first);
  }
  if (first < count)
  {
    const std::size_t rest = count - first;
    std::array<float, 3 * MostFloats> group1{};
    std::array<float, 3 * MostFloats> group2{};
    std::array<float, MostFloats> group{};
    std::copy_n(lab1 + 3 * first, 3 * rest, group1.begin());
    std::copy_n(lab2 + 3 * first, 3 * rest, group2.begin());
    oneGroup(factors, group1.data(), group2.data(), group.data());
    std::copy_n(group.begin(), rest, result + first);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(differencesInFloat);

template <>
void differencesCIEDE2000<float>(const CIEDE2000Factors& factors, const float* lab1,
  const float* lab2, float* difference, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(differencesInFloat)(factors, lab1, lab2, difference, count);
}

} // namespace msi
#endif

#include "Kernels/Difference/CIEDE2000Blocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Difference/CIEDE2000Blocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Colorimetry/ColorVectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace
{
// The formula without angles: a hue is a unit vector, the mean hue is the bisector of two of them.
// The equation numbers are those of Sharma, Wu and Dalal, 2005.

struct Direction
{
  Vector cosine;
  Vector sine;
};

Vector length(Vector x, Vector y)
{
  return hn::Sqrt(hn::Add(square(x), square(y)));
}

// sqrt(C^7 / (C^7 + 25^7)), Eqs. 4 and 17. The bound keeps C^7 finite and changes no digit.
Vector saturation(Vector chroma)
{
  const Vector ratio = hn::Min(hn::Mul(chroma, set(1.0 / 25.0)), set(1e30));
  const Vector cube = hn::Mul(square(ratio), ratio);
  const Vector seventh = hn::Mul(square(cube), ratio);
  return hn::Sqrt(hn::Div(seventh, hn::Add(seventh, set(1.0))));
}

// The direction of (x, y), whose length is given; the zero vector for the neutral color.
Direction direction(Vector x, Vector y, Vector length)
{
  const Mask neutral = hn::Eq(length, hn::Zero(Doubles()));
  const Vector inverse = hn::IfThenZeroElse(neutral, hn::Div(set(1.0), length));
  return { hn::Mul(x, inverse), hn::Mul(y, inverse) };
}

// Whether the second hue is reached from the first by turning through 0..180 degrees; Eq. 10. For
// opposite hues (the sine of their angle is zero) that is so if the first one is below 180 degrees.
Mask turnsForward(Vector a1, Vector b1, Vector a2, Vector b2)
{
  const Vector zero = hn::Zero(Doubles());
  const Vector turn = hn::Sub(hn::Mul(a1, b2), hn::Mul(a2, b1));
  const Mask firstBelow180 = hn::Or(hn::Gt(b1, zero), hn::And(hn::Eq(b1, zero), hn::Gt(a1, zero)));
  return hn::Or(hn::Gt(turn, zero), hn::And(hn::Eq(turn, zero), firstBelow180));
}

// Whether a mean hue lies within 0..60 degrees: mean hues run from 0 to 360 degrees, so that these
// are far from 275. The side of zero is told by the sine of the sum of the hues, which is exactly zero
// for mirrored colors, unless one color is neutral.
Mask isPastRed(const Colors& lab1, const Colors& lab2, Vector chromaProduct, const Direction& mean)
{
  const Vector zero = hn::Zero(Doubles());
  const Vector sum = hn::Add(hn::Mul(lab1.second, lab2.third), hn::Mul(lab2.second, lab1.third));
  const Mask onRed =
    hn::And(hn::Eq(sum, zero), hn::Or(hn::Gt(chromaProduct, zero), hn::Ge(mean.sine, zero)));
  return hn::And(hn::Gt(mean.cosine, set(0.5)), hn::Or(hn::Gt(sum, zero), onRed));
}

// The mean hue, Eq. 14: the bisector of the shorter arc between two hues, or the hue of the color
// that has one, or 0 degrees. Hues apart by more than 90 degrees have a difference vector that is
// longer than their sum; the bisector is perpendicular to it.
Direction meanHue(const Direction& hue1, const Direction& hue2, Mask forward)
{
  const Vector zero = hn::Zero(Doubles());
  const Vector cosine = hn::Add(hn::Mul(hue1.cosine, hue2.cosine), hn::Mul(hue1.sine, hue2.sine));
  const Mask wide = hn::Lt(cosine, zero);
  const Vector apartX = hn::Sub(hue1.cosine, hue2.cosine);
  const Vector apartY = hn::Sub(hue1.sine, hue2.sine);
  const Vector turnedX = hn::IfThenElse(forward, hn::Neg(apartY), apartY);
  const Vector turnedY = hn::IfThenElse(forward, apartX, hn::Neg(apartX));
  const Vector x = hn::IfThenElse(wide, turnedX, hn::Add(hue1.cosine, hue2.cosine));
  const Vector y = hn::IfThenElse(wide, turnedY, hn::Add(hue1.sine, hue2.sine));
  const Vector size = length(x, y);
  Direction mean = direction(x, y, size);
  mean.cosine = hn::IfThenElse(hn::Eq(size, zero), set(1.0), mean.cosine);
  return mean;
}

// T, Eq. 15, by the cosines and sines of the multiple angles.
Vector hueWeight(const Direction& hue)
{
  const Vector c1 = hue.cosine;
  const Vector s1 = hue.sine;
  const Vector c2 = hn::Sub(square(c1), square(s1));
  const Vector s2 = hn::Mul(hn::Add(c1, c1), s1);
  const Vector c3 = hn::Sub(hn::Mul(c2, c1), hn::Mul(s2, s1));
  const Vector s3 = hn::Add(hn::Mul(s2, c1), hn::Mul(c2, s1));
  const Vector c4 = hn::Sub(square(c2), square(s2));
  const Vector s4 = hn::Mul(hn::Add(c2, c2), s2);
  // cos(n h + phase) = cos(phase) cos(n h) - sin(phase) sin(n h).
  Vector weight = set(1.0);
  weight = hn::Sub(weight, hn::Mul(set(0.17 * 0.86602540378443865), c1)); // 30 degrees
  weight = hn::Sub(weight, hn::Mul(set(0.17 * 0.5), s1));
  weight = hn::Add(weight, hn::Mul(set(0.24), c2));
  weight = hn::Add(weight, hn::Mul(set(0.32 * 0.99452189536827333), c3)); // 6 degrees
  weight = hn::Sub(weight, hn::Mul(set(0.32 * 0.10452846326765347), s3));
  weight = hn::Sub(weight, hn::Mul(set(0.20 * 0.45399049973954680), c4)); // 63 degrees
  weight = hn::Sub(weight, hn::Mul(set(0.20 * 0.89100652418836786), s4));
  return weight;
}

// exp(-(d / 25)^2 / 16) for the angle d to 275 degrees, in 1 - cos(d / 2), up to d = 130 degrees,
// where the exponential of Eq. 16 is down to 2e-12. Chebyshev fit, error below 7e-17.
constexpr std::array<double, 11> BlueGaussianRoot{ 1.7891738282267391302e-6,
  -4.1471852386841178252e-5, 6.1463306960700889263e-4, -6.3759673673027223053e-3,
  4.6520732432997021367e-2, -2.3751571335774789814e-1, 8.3746583941956714605e-1,
  -1.9861349623329166722, 3.0108740967998433906, -2.62624508000936568, 9.9999999999999992996e-1 };
constexpr double BlueGaussianEnd = 0.57738173825930056;
// sin(60 degrees x) / x in x^2, for x within 0..1. Chebyshev fit, error below 2e-16.
constexpr std::array<double, 7> RotationSine{ 2.8717693581746743442e-10, -4.1599031209241460745e-8,
  4.1734384603090341239e-6, -2.7401212873156941653e-4, 1.0494502221429156968e-2,
  -1.9139676963146235564e-1, 1.0471975511965975623 };

// sin(2 delta theta), Eqs. 16 and 19.
Vector rotation(const Direction& hue, Mask pastRed)
{
  const Vector zero = hn::Zero(Doubles());
  const Vector cosine = hn::Sub(hn::Mul(hue.cosine, set(0.087155742747658174)),
    hn::Mul(hue.sine, set(0.99619469809174553))); // of the angle to 275 degrees
  const Vector halfCosine = hn::Sqrt(hn::Max(hn::Mul(hn::Add(cosine, set(1.0)), set(0.5)), zero));
  const Vector halfVersine = hn::Min(hn::Sub(set(1.0), halfCosine), set(BlueGaussianEnd));
  const Vector root = polynomial(halfVersine, BlueGaussianRoot);
  const Vector gaussian = square(square(square(square(root))));
  return hn::IfThenZeroElse(pastRed, hn::Mul(gaussian, polynomial(square(gaussian), RotationSine)));
}

Vector difference(const CIEDE2000Factors& factors, const Colors& lab1, const Colors& lab2)
{
  const Vector half = set(0.5);
  const Vector meanChroma =
    hn::Mul(half, hn::Add(length(lab1.second, lab1.third), length(lab2.second, lab2.third)));
  // 1 + G, Eqs. 4 and 5.
  const Vector stretch = hn::Sub(set(1.5), hn::Mul(half, saturation(meanChroma)));
  const Vector a1 = hn::Mul(stretch, lab1.second);
  const Vector a2 = hn::Mul(stretch, lab2.second);
  const Vector chroma1 = length(a1, lab1.third);
  const Vector chroma2 = length(a2, lab2.third);
  const Direction hue1 = direction(a1, lab1.third, chroma1);
  const Direction hue2 = direction(a2, lab2.third, chroma2);
  const Mask forward = turnsForward(lab1.second, lab1.third, lab2.second, lab2.third);

  // Eqs. 8, 9 and 11. Differences of nearly equal colors are taken before they are squared or multiplied, so that no digits
  // cancel; every line changes its sign alone when the colors change places.
  const Vector deltaL = hn::Sub(lab2.first, lab1.first);
  const Vector deltaA = hn::Mul(stretch, hn::Sub(lab2.second, lab1.second));
  const Vector deltaB = hn::Sub(lab2.third, lab1.third);
  const Vector sumA = hn::Add(a1, a2);
  const Vector sumB = hn::Add(lab1.third, lab2.third);
  const Vector sumChroma = hn::Add(chroma1, chroma2);
  const Vector zero = hn::Zero(Doubles());
  const Vector deltaC = hn::IfThenZeroElse(hn::Eq(sumChroma, zero),
    hn::Div(hn::Add(hn::Mul(deltaA, sumA), hn::Mul(deltaB, sumB)), sumChroma));
  const Vector chromaProduct = hn::Mul(chroma1, chroma2);
  const Vector inner = hn::Add(hn::Mul(a1, a2), hn::Mul(lab1.third, lab2.third));
  // Hues less than 90 degrees apart: twice the sine of the half angle is the sine over the cosine of the half.
  const Vector outer = hn::Mul(half, hn::Sub(hn::Mul(sumA, deltaB), hn::Mul(sumB, deltaA)));
  const Vector narrowH = hn::Div(outer, hn::Sqrt(hn::Mul(half, hn::Add(chromaProduct, inner))));
  // Others: the chord of the hue angle.
  const Vector chordX = hn::Sub(hue2.cosine, hue1.cosine);
  const Vector chordY = hn::Sub(hue2.sine, hue1.sine);
  const Vector hueDistance =
    hn::Sqrt(hn::Mul(chromaProduct, hn::Add(square(chordX), square(chordY))));
  const Vector wideH = hn::IfThenElse(forward, hueDistance, hn::Neg(hueDistance));
  const Vector deltaH = hn::IfThenElse(hn::Gt(inner, zero), narrowH, wideH);

  const Vector meanPrimedChroma = hn::Mul(half, sumChroma);
  const Direction hue = meanHue(hue1, hue2, forward);
  // Eqs. 18, 19 and 20.
  const Vector fromMiddle =
    square(hn::Sub(hn::Mul(half, hn::Add(lab1.first, lab2.first)), set(50.0)));
  const Vector weightL = hn::Add(
    set(1.0), hn::Div(hn::Mul(set(0.015), fromMiddle), hn::Sqrt(hn::Add(set(20.0), fromMiddle))));
  const Vector weightC = hn::Add(set(1.0), hn::Mul(set(0.045), meanPrimedChroma));
  const Vector weightH =
    hn::Add(set(1.0), hn::Mul(hn::Mul(set(0.015), meanPrimedChroma), hueWeight(hue)));
  // -R_T, Eq. 21.
  const Mask pastRed = isPastRed(lab1, lab2, chromaProduct, hue);
  const Vector rotate =
    hn::Mul(hn::Mul(set(2.0), saturation(meanPrimedChroma)), rotation(hue, pastRed));

  // Eq. 22.
  const Vector l = hn::Div(deltaL, hn::Mul(set(factors.kL), weightL));
  const Vector c = hn::Div(deltaC, hn::Mul(set(factors.kC), weightC));
  const Vector h = hn::Div(deltaH, hn::Mul(set(factors.kH), weightH));
  const Vector squared =
    hn::Sub(hn::Add(hn::Add(square(l), square(c)), square(h)), hn::Mul(rotate, hn::Mul(c, h)));
  return hn::Sqrt(squared);
}

void differences(const CIEDE2000Factors& factors, const double* lab1, const double* lab2,
  double* result, std::size_t count)
{
  const std::size_t lanes = hn::Lanes(Doubles());
  std::size_t first = 0;
  for (; first + lanes <= count; first += lanes)
  {
    storeValues(difference(factors, loadColors(lab1 + 3 * first), loadColors(lab2 + 3 * first)),
      result + first);
  }
  if (first < count)
  {
    const std::size_t rest = count - first;
    std::array<double, 3 * MostLanes> group1{};
    std::array<double, 3 * MostLanes> group2{};
    std::array<double, MostLanes> group{};
    std::copy_n(lab1 + 3 * first, 3 * rest, group1.begin());
    std::copy_n(lab2 + 3 * first, 3 * rest, group2.begin());
    storeValues(
      difference(factors, loadColors(group1.data()), loadColors(group2.data())), group.data());
    std::copy_n(group.begin(), rest, result + first);
  }
}
}

void differencesDouble(const CIEDE2000Factors& factors, const double* lab1, const double* lab2,
  double* result, std::size_t count)
{
  differences(factors, lab1, lab2, result, count);
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(differencesDouble);

template <>
void differencesCIEDE2000<double>(const CIEDE2000Factors& factors, const double* lab1,
  const double* lab2, double* difference, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(differencesDouble)(factors, lab1, lab2, difference, count);
}

} // namespace msi
#endif

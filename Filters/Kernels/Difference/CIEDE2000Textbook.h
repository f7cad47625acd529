// For tests: CIEDE2000 as Sharma, Wu and Dalal print it, doi 10.1002/col.20070, with angles in
// degrees and in long double. It shares nothing with the kernel but its source.
#pragma once

#include <cmath>

namespace textbook
{

using Real = long double;

struct Lab
{
  Real L;
  Real a;
  Real b;
};

inline Real radians(Real degrees)
{
  return degrees * 3.14159265358979323846264338327950288L / 180.0L;
}

inline Real hueAngle(Real a, Real b)
{
  if (a == 0.0L && b == 0.0L)
  {
    return 0.0L;
  }
  const Real degrees = std::atan2(b, a) / radians(1.0L);
  return degrees < 0.0L ? degrees + 360.0L : degrees;
}

inline Real saturation(Real chroma)
{
  const Real seventh = std::pow(chroma, 7.0L);
  return std::sqrt(seventh / (seventh + 6103515625.0L));
}

inline Real deltaE2000(const Lab& x, const Lab& y, Real kL = 1.0L, Real kC = 1.0L, Real kH = 1.0L)
{
  const Real meanChroma = (std::hypot(x.a, x.b) + std::hypot(y.a, y.b)) / 2.0L;
  const Real G = 0.5L * (1.0L - saturation(meanChroma));
  const Real a1 = (1.0L + G) * x.a;
  const Real a2 = (1.0L + G) * y.a;
  const Real C1 = std::hypot(a1, x.b);
  const Real C2 = std::hypot(a2, y.b);
  const Real h1 = hueAngle(a1, x.b);
  const Real h2 = hueAngle(a2, y.b);

  const bool neutral = C1 * C2 == 0.0L;
  // Opposite hues are 180 degrees apart, whatever their angles are rounded to.
  const bool opposite = !neutral && x.a * y.b == y.a * x.b && std::abs(h1 - h2) > 90.0L;
  const bool near = opposite || std::abs(h1 - h2) <= 180.0L;
  Real dh = h2 - h1;
  Real meanHue = (h1 + h2) / 2.0L;
  if (neutral)
  {
    dh = 0.0L;
    meanHue = h1 + h2;
  }
  else if (!near)
  {
    dh += dh > 0.0L ? -360.0L : 360.0L;
    // The mean of mirrored hues is 0 degrees, whatever their angles are rounded to.
    const bool mirrored = x.a * y.b == -y.a * x.b;
    meanHue += h1 + h2 < 360.0L && !mirrored ? 180.0L : -180.0L;
  }

  const Real dL = y.L - x.L;
  const Real dC = C2 - C1;
  const Real dH = 2.0L * std::sqrt(C1 * C2) * std::sin(radians(dh / 2.0L));
  const Real meanL = (x.L + y.L) / 2.0L;
  const Real meanC = (C1 + C2) / 2.0L;
  const Real T = 1.0L - 0.17L * std::cos(radians(meanHue - 30.0L)) +
    0.24L * std::cos(radians(2.0L * meanHue)) + 0.32L * std::cos(radians(3.0L * meanHue + 6.0L)) -
    0.20L * std::cos(radians(4.0L * meanHue - 63.0L));
  const Real fromBlue = (meanHue - 275.0L) / 25.0L;
  const Real dTheta = 30.0L * std::exp(-fromBlue * fromBlue);
  const Real fromMiddle = (meanL - 50.0L) * (meanL - 50.0L);
  const Real SL = 1.0L + 0.015L * fromMiddle / std::sqrt(20.0L + fromMiddle);
  const Real SC = 1.0L + 0.045L * meanC;
  const Real SH = 1.0L + 0.015L * meanC * T;
  const Real RT = -std::sin(radians(2.0L * dTheta)) * 2.0L * saturation(meanC);
  const Real l = dL / (kL * SL);
  const Real c = dC / (kC * SC);
  const Real h = dH / (kH * SH);
  return std::sqrt(l * l + c * c + h * h + RT * c * h);
}

} // namespace textbook

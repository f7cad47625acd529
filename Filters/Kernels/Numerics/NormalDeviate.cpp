#include "Kernels/Numerics/NormalDeviate.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double Root2 = 1.4142135623730951;
constexpr double InverseRootTwoPi = 0.3989422804014327;

// The x >= 0 whose upper tail has this probability (at most 1/2): Newton's method on the logarithm of the
// tail, which is concave, from the asymptotic value.
double upperQuantile(double probability)
{
  double x = std::sqrt(std::fmax(0.0, -2.0 * std::log(2.0 * probability)));
  for (int i = 0; i < 60; ++i)
  {
    const double tail = 0.5 * std::erfc(x / Root2);
    const double density = InverseRootTwoPi * std::exp(-0.5 * x * x);
    const double step = tail / density * std::log(tail / probability);
    x += step;
    if (std::abs(step) < 1e-14)
    {
      break;
    }
  }
  return x;
}
}

const NormalDeviate& NormalDeviate::instance()
{
  static const NormalDeviate deviate;
  return deviate;
}

NormalDeviate::NormalDeviate()
  : Parabolas{}
{
  constexpr double Scale = 0x1p-32;
  for (std::size_t cell = 0; cell < Cells; ++cell)
  {
    const int octave = static_cast<int>(cell >> CellBits) - 1;
    const auto place = static_cast<double>(cell & ((std::size_t{ 1 } << CellBits) - 1));
    const double width = std::ldexp(1.0, octave - CellBits) * Scale;
    const double first = std::ldexp(1.0, octave) * Scale + place * width;
    const double a = upperQuantile(first);
    const double b = upperQuantile(first + 0.5 * width);
    const double c = upperQuantile(first + width);
    float* parabola = Parabolas.data() + CellStride * cell;
    parabola[0] = static_cast<float>(a);
    parabola[1] = static_cast<float>(4.0 * b - 3.0 * a - c);
    parabola[2] = static_cast<float>(2.0 * a - 4.0 * b + 2.0 * c);
  }
}

} // namespace msi

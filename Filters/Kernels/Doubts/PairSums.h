// What a real and a simulated series of values have in common.
#pragma once

#include <cmath>

namespace msi
{

// Sums over the places at which both have a value.
struct PairSums
{
  double n = 0.0, real = 0.0, simulated = 0.0;
  double realSquares = 0.0, simulatedSquares = 0.0, products = 0.0;

  template <typename Scalar>
  void add(Scalar realValue, Scalar simulatedValue) noexcept
  {
    const auto r = static_cast<double>(realValue);
    const auto s = static_cast<double>(simulatedValue);
    if (std::isfinite(r) && std::isfinite(s))
    {
      n += 1.0;
      real += r;
      simulated += s;
      realSquares += r * r;
      simulatedSquares += s * s;
      products += r * s;
    }
  }
  // About the means.
  double ofReal() const noexcept { return realSquares - real * real / count(); }
  double ofSimulated() const noexcept { return simulatedSquares - simulated * simulated / count(); }
  double ofBoth() const noexcept { return products - real * simulated / count(); }
  // Squared and with its sign.
  double correlation() const noexcept
  {
    return ofBoth() * std::fabs(ofBoth()) / (ofSimulated() * std::fmax(ofReal(), 1e-300));
  }
  // The deviation of what is simulated is small beside it.
  bool isFlat() const noexcept { return ofSimulated() <= Flat * Flat * simulatedSquares; }
  // What is real is the same everywhere but for rounding.
  bool isSteady() const noexcept { return ofReal() <= Rounding * realSquares; }
  // Of the straight line through the origin: its slope, and the squares that it leaves.
  double gain() const noexcept { return products / std::fmax(simulatedSquares, 1e-30); }
  double left() const noexcept { return realSquares - gain() * products; }

private:
  static constexpr double Flat = 0.05;
  static constexpr double Rounding = 1e-9;
  double count() const noexcept { return std::fmax(n, 1.0); }
};

} // namespace msi

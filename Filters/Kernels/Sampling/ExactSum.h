// Sums that do not depend on the order of their terms.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace msi
{

// A sum in 128-bit fixed point with a quantum of 2^-60: terms are rounded to the quantum once, integer
// addition does the rest, so every split over threads, pieces and ranks gives the same bytes.
//
// Range: |term| <= 2^40 and at most 2^27 terms of that size; the caller keeps to it.
class ExactSum
{
public:
  static constexpr double LargestTerm = 1099511627776.0; // 2^40

  void add(double term) noexcept { Value += static_cast<Integer>(std::ldexp(term, Shift)); }
  void merge(const ExactSum& other) noexcept { Value += other.Value; }
  double value() const noexcept { return std::ldexp(static_cast<double>(Value), -Shift); }

  // Three limbs that may be added element by element over up to 2^14 ranks before fromLimbs().
  using Limbs = std::array<std::int64_t, 3>;
  Limbs limbs() const noexcept
  {
    return { static_cast<std::int64_t>(Value & LimbMask),
      static_cast<std::int64_t>((Value >> LimbBits) & LimbMask),
      static_cast<std::int64_t>(Value >> (2 * LimbBits)) };
  }
  static ExactSum fromLimbs(const Limbs& limbs) noexcept
  {
    ExactSum sum;
    sum.Value =
      (static_cast<Integer>(limbs[2]) * LimbBase + static_cast<Integer>(limbs[1])) * LimbBase +
      static_cast<Integer>(limbs[0]);
    return sum;
  }

private:
  __extension__ using Integer = __int128;
  static constexpr int Shift = 60;
  static constexpr int LimbBits = 48;
  static constexpr Integer LimbBase = static_cast<Integer>(1) << LimbBits;
  static constexpr Integer LimbMask = LimbBase - 1;

  Integer Value = 0;
};

} // namespace msi

// An unsigned integer wide enough for the exact sums of squares of floats.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace msi
{

// 768 bits. Overflow is the caller's to rule out.
class WideInteger
{
public:
  // Adds value * 2^shift.
  void add(std::uint64_t value, int shift) noexcept
  {
    std::size_t limb = static_cast<std::size_t>(shift) / 32;
    const int bits = shift % 32;
    // value * 2^bits, in three limbs.
    const std::uint64_t low = (value & Low) << bits;
    const std::uint64_t high = ((value >> 32) << bits) + (low >> 32);
    std::uint64_t carry = 0;
    for (std::uint64_t part : { low & Low, high & Low, high >> 32 })
    {
      carry = addToLimb(limb++, part + carry);
    }
    while (carry != 0)
    {
      carry = addToLimb(limb++, carry);
    }
  }

  WideInteger& operator-=(const WideInteger& smaller) noexcept
  {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < Limbs.size(); ++i)
    {
      const std::uint64_t taken = smaller.Limbs[i] + borrow;
      borrow = Limbs[i] < taken ? 1 : 0;
      Limbs[i] = (Limbs[i] - taken) & Low;
    }
    return *this;
  }

  friend WideInteger operator*(const WideInteger& a, const WideInteger& b) noexcept
  {
    WideInteger product;
    for (std::size_t i = 0; i < a.Limbs.size(); ++i)
    {
      for (std::size_t j = 0; a.Limbs[i] != 0 && i + j < b.Limbs.size(); ++j)
      {
        if (b.Limbs[j] != 0)
        {
          product.add(a.Limbs[i] * b.Limbs[j], static_cast<int>(32 * (i + j)));
        }
      }
    }
    return product;
  }

  friend bool operator<(const WideInteger& a, const WideInteger& b) noexcept
  {
    for (std::size_t i = a.Limbs.size(); i-- > 0;)
    {
      if (a.Limbs[i] != b.Limbs[i])
      {
        return a.Limbs[i] < b.Limbs[i];
      }
    }
    return false;
  }

  // This * 2^exponent, rounded once.
  double toDouble(int exponent) const noexcept
  {
    std::size_t top = Limbs.size();
    while (top > 0 && Limbs[top - 1] == 0)
    {
      --top;
    }
    if (top <= 2)
    {
      return std::ldexp(static_cast<double>((Limbs[1] << 32) + Limbs[0]), exponent);
    }
    // The upper 64 bits, the lowest of which also stands for all bits below.
    int shift = 0;
    while (((Limbs[top - 1] << shift) & (Low - (Low >> 1))) == 0)
    {
      ++shift;
    }
    std::uint64_t upper = (Limbs[top - 1] << 32) + Limbs[top - 2];
    const std::uint64_t next = Limbs[top - 3] << shift;
    upper = (upper << shift) + (next >> 32);
    bool rest = (next & Low) != 0;
    for (std::size_t i = 0; i + 3 < top; ++i)
    {
      rest = rest || Limbs[i] != 0;
    }
    const int scale = static_cast<int>(32 * (top - 2)) - shift + exponent;
    return std::ldexp(static_cast<double>(upper | (rest ? 1U : 0U)), scale);
  }

private:
  static constexpr std::uint64_t Low = 0xffffffffU;

  std::uint64_t addToLimb(std::size_t limb, std::uint64_t value) noexcept
  {
    if (limb >= Limbs.size())
    {
      return 0;
    }
    const std::uint64_t sum = Limbs[limb] + value;
    Limbs[limb] = sum & Low;
    return sum >> 32;
  }

  std::array<std::uint64_t, 24> Limbs{}; // 32 bits each, the lowest first
};

} // namespace msi

// What the two passes of the error statistics share: floats as ordered integers, and arrays that add.
#pragma once

#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

namespace msi::errorpass
{

// The first pass counts the upper halves of the keys of the values, the second the lower halves.
constexpr std::size_t HalfKeys = 1U << 16;

inline std::uint32_t bitsOf(float value) noexcept
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

inline bool isFinite(std::uint32_t bits) noexcept
{
  return (bits & 0x7f800000U) != 0x7f800000U;
}

// An integer that orders as the finite floats do; the two zeros share one.
inline std::uint32_t keyOf(std::uint32_t bits) noexcept
{
  const bool negative = (bits & 0x80000000U) != 0 && bits != 0x80000000U;
  return negative ? ~bits : bits | 0x80000000U;
}

inline double valueOfKey(std::uint32_t key) noexcept
{
  const std::uint32_t bits = (key & 0x80000000U) != 0 ? key & 0x7fffffffU : ~key;
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof(value));
  return static_cast<double>(value);
}

inline void requireLength(std::size_t length, std::size_t expected, const char* what)
{
  if (length != expected)
  {
    reject(
      "an array of ", length, " integers is not the state of ", what, ", which has ", expected);
  }
}

inline void addTo(std::vector<std::int64_t>& state, const std::vector<std::int64_t>& other) noexcept
{
  std::transform(state.begin(), state.end(), other.begin(), state.begin(), std::plus<>());
}

} // namespace msi::errorpass

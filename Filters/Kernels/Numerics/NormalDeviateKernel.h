// The inner loop of CounterRandom::normals().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace msi
{

// The constants of Philox4x32-10 (source in CounterRandom.h).
struct Philox
{
  static constexpr std::uint32_t Multiplier0 = 0xD2511F53;
  static constexpr std::uint32_t Multiplier1 = 0xCD9E8D57;
  static constexpr std::uint32_t Weyl0 = 0x9E3779B9;
  static constexpr std::uint32_t Weyl1 = 0xBB67AE85;
  static constexpr int Rounds = 10;
};

// The deviates of the counters first, first + 1, ..., four of each, as far as whole vectors go; returns how many
// it wrote, a multiple of four. SIMD chosen at run time (Highway); bytes as NormalDeviate.
std::size_t drawNormals(std::array<std::uint32_t, 2> key, std::uint32_t stream, std::uint64_t first,
  float* deviates, std::size_t count) noexcept;

} // namespace msi

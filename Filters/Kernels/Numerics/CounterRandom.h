// Random numbers that depend on a place, not on a history.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace msi
{

// Philox4x32-10: ten rounds of multiply and exchange turn a counter and a key into four words.
//
// Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as easy as
//         1, 2, 3", SC11, doi:10.1145/2063384.2063405.
// The same counter and key give the same words on every machine, in any order, on any thread.
std::array<std::uint32_t, 4> philox4x32(
  std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) noexcept;

// Independent streams of random numbers addressed by (seed, stream, index).
//
// Use one stream for one purpose (shot noise of channel 3, texture of swatch 7) and the index of
// the pixel or sample within it: any split over threads, pieces or ranks draws the same numbers.
class CounterRandom
{
public:
  explicit CounterRandom(std::uint64_t seed, std::uint32_t stream = 0) noexcept
    : Key{ static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32) }
    , Stream(stream)
  {
  }

  // Uniform in the open interval (0, 1), 32 bits; `lane` 0..3 are independent of one another.
  double uniform(std::uint64_t index, unsigned lane = 0) const noexcept;

  // Two independent standard normal deviates (Box-Muller).
  std::array<double, 2> normalPair(std::uint64_t index) const noexcept;
  double normal(std::uint64_t index) const noexcept { return normalPair(index)[0]; }

  // Standard normal deviates number first, first + 1, ..., one after the other (NormalDeviate): other numbers than
  // those of normal(), and many times faster.
  void normals(std::uint64_t first, float* deviates, std::size_t count) const noexcept;

private:
  std::array<std::uint32_t, 4> words(std::uint64_t index) const noexcept;

  std::array<std::uint32_t, 2> Key;
  std::uint32_t Stream;
};

} // namespace msi

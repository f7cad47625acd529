#include "Kernels/Numerics/CounterRandom.h"

#include "Kernels/Numerics/Angle.h"
#include "Kernels/Numerics/NormalDeviate.h"
#include "Kernels/Numerics/NormalDeviateKernel.h"

#include <cmath>

namespace msi
{

namespace
{
// The middle of the 2^-32 wide cell: never 0, never 1.
constexpr double openUniform(std::uint32_t word) noexcept
{
  return (static_cast<double>(word) + 0.5) * 0x1p-32;
}
}

std::array<std::uint32_t, 4> philox4x32(
  std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) noexcept
{
  for (int round = 0; round < Philox::Rounds; ++round)
  {
    const std::uint64_t product0 = std::uint64_t{ Philox::Multiplier0 } * counter[0];
    const std::uint64_t product1 = std::uint64_t{ Philox::Multiplier1 } * counter[2];
    counter = { static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
      static_cast<std::uint32_t>(product1),
      static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
      static_cast<std::uint32_t>(product0) };
    key[0] += Philox::Weyl0;
    key[1] += Philox::Weyl1;
  }
  return counter;
}

std::array<std::uint32_t, 4> CounterRandom::words(std::uint64_t index) const noexcept
{
  return philox4x32(
    { static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), Stream, 0 }, Key);
}

double CounterRandom::uniform(std::uint64_t index, unsigned lane) const noexcept
{
  return openUniform(words(index)[lane & 3U]);
}

std::array<double, 2> CounterRandom::normalPair(std::uint64_t index) const noexcept
{
  const auto word = words(index);
  const double radius = std::sqrt(-2.0 * std::log(openUniform(word[0])));
  const double angle = TwoPi * openUniform(word[1]);
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

void CounterRandom::normals(std::uint64_t first, float* deviates, std::size_t count) const noexcept
{
  // Four deviates from each counter, whatever the first one asked for.
  const NormalDeviate& deviate = NormalDeviate::instance();
  std::size_t done = 0;
  while (done < count)
  {
    const std::uint64_t index = first + done;
    if (index % 4 == 0)
    {
      done += drawNormals(Key, Stream, index / 4, deviates + done, count - done);
    }
    if (done < count)
    {
      const auto word = words((first + done) / 4);
      for (std::size_t lane = (first + done) % 4; lane < 4 && done < count; ++lane)
      {
        deviates[done++] = deviate(word[lane]);
      }
    }
  }
}

} // namespace msi

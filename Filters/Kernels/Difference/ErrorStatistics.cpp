#include "Kernels/Difference/ErrorStatistics.h"

#include "Kernels/Difference/ErrorPass.h"
#include "Kernels/Difference/WideInteger.h"

#include <cmath>
#include <utility>

namespace msi
{

using namespace errorpass;

namespace
{
// A finite float is m 2^(s - 149) with an integer m below 2^24 and s, its shift, within 0..253. The
// state holds, for each shift, the sums of m with its sign and of m^2 in two halves.
constexpr std::size_t Shifts = 254;
constexpr int LowestExponent = -149;
constexpr std::uint64_t HalfSquare = 1U << 24;

constexpr std::size_t CountAt = 0;
constexpr std::size_t NonFiniteAt = 1;
constexpr std::size_t SumAt = 2;
constexpr std::size_t UpperSquareAt = SumAt + Shifts;
constexpr std::size_t LowerSquareAt = UpperSquareAt + Shifts;
constexpr std::size_t HistogramAt = LowerSquareAt + Shifts;
constexpr std::size_t StateSize = HistogramAt + HalfKeys;

std::uint64_t magnitude(std::int64_t value) noexcept
{
  return value < 0 ? ~static_cast<std::uint64_t>(value) + 1U : static_cast<std::uint64_t>(value);
}

// The sum of the values, times 2^149.
struct SignedSum
{
  WideInteger size;
  bool negative;
};

SignedSum sumOf(const std::vector<std::int64_t>& state)
{
  WideInteger positive;
  WideInteger negative;
  for (std::size_t shift = 0; shift < Shifts; ++shift)
  {
    const std::int64_t sum = state[SumAt + shift];
    (sum < 0 ? negative : positive).add(magnitude(sum), static_cast<int>(shift));
  }
  const bool below = positive < negative;
  WideInteger size = below ? negative : positive;
  size -= below ? positive : negative;
  return { size, below };
}

// The sum of the squares, times 2^298.
WideInteger squaresOf(const std::vector<std::int64_t>& state)
{
  WideInteger squares;
  for (std::size_t shift = 0; shift < Shifts; ++shift)
  {
    const int twice = 2 * static_cast<int>(shift);
    squares.add(magnitude(state[UpperSquareAt + shift]), twice + 24);
    squares.add(magnitude(state[LowerSquareAt + shift]), twice);
  }
  return squares;
}

}

ErrorStatistics::ErrorStatistics()
  : State(StateSize, 0)
{
}

void ErrorStatistics::add(const float* values, std::size_t count) noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t bits = bitsOf(values[i]);
    if (!isFinite(bits))
    {
      ++State[NonFiniteAt];
      continue;
    }
    const std::uint32_t exponent = (bits >> 23) & 0xffU;
    const std::uint32_t fraction = bits & 0x7fffffU;
    const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | 0x800000U;
    const std::size_t shift = exponent == 0 ? 0 : exponent - 1;
    const std::uint64_t square = mantissa * mantissa;
    const auto signedMantissa = static_cast<std::int64_t>(mantissa);
    ++State[CountAt];
    State[SumAt + shift] += (bits & 0x80000000U) != 0 ? -signedMantissa : signedMantissa;
    State[UpperSquareAt + shift] += static_cast<std::int64_t>(square / HalfSquare);
    State[LowerSquareAt + shift] += static_cast<std::int64_t>(square % HalfSquare);
    ++State[HistogramAt + (keyOf(bits) >> 16)];
  }
}

void ErrorStatistics::merge(const ErrorStatistics& other) noexcept
{
  addTo(State, other.State);
}

std::int64_t ErrorStatistics::count() const noexcept
{
  return State[CountAt];
}

std::int64_t ErrorStatistics::nonFinite() const noexcept
{
  return State[NonFiniteAt];
}

const std::int64_t* ErrorStatistics::histogram() const noexcept
{
  return State.data() + HistogramAt;
}

double ErrorStatistics::mean() const
{
  const SignedSum sum = sumOf(State);
  const double mean = sum.size.toDouble(LowestExponent) / static_cast<double>(count());
  return sum.negative ? -mean : mean;
}

// n^2 times the variance is n sum(x^2) - sum(x)^2, an integer here.
double ErrorStatistics::standardDeviation() const
{
  WideInteger number;
  number.add(static_cast<std::uint64_t>(count()), 0);
  WideInteger spread = number * squaresOf(State);
  const WideInteger sum = sumOf(State).size;
  spread -= sum * sum;
  const double n = static_cast<double>(count());
  return std::sqrt(spread.toDouble(2 * LowestExponent)) / n;
}

ErrorStatistics ErrorStatistics::fromArray(std::vector<std::int64_t> state)
{
  requireLength(state.size(), StateSize, "ErrorStatistics");
  ErrorStatistics statistics;
  statistics.State = std::move(state);
  return statistics;
}

} // namespace msi

#include "Formats/Images/BandInterleave.h"

#include "Formats/Images/SampleTypes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace msi
{

namespace
{
constexpr std::size_t TileValues = 4096; // 16 KB of float
constexpr std::size_t BandsAtOnce = 8;

template <std::size_t Size>
struct BitsOfSize;
template <>
struct BitsOfSize<1>
{
  using Type = std::uint8_t;
  static Type swapped(Type bits) noexcept { return bits; }
};
template <>
struct BitsOfSize<2>
{
  using Type = std::uint16_t;
  static Type swapped(Type bits) noexcept { return __builtin_bswap16(bits); }
};
template <>
struct BitsOfSize<4>
{
  using Type = std::uint32_t;
  static Type swapped(Type bits) noexcept { return __builtin_bswap32(bits); }
};
template <>
struct BitsOfSize<8>
{
  using Type = std::uint64_t;
  static Type swapped(Type bits) noexcept { return __builtin_bswap64(bits); }
};

template <typename Stored, bool Swap>
Stored loadSample(const unsigned char* bytes) noexcept
{
  using Bits = BitsOfSize<sizeof(Stored)>;
  typename Bits::Type bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  if constexpr (Swap)
  {
    bits = Bits::swapped(bits);
  }
  Stored value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

template <typename Stored>
bool isRepresentable(double value) noexcept
{
  if constexpr (std::is_floating_point_v<Stored>)
  {
    return !std::isnan(value);
  }
  else
  {
    // The largest value of 64 bits is no double; one more is.
    const double end = std::ldexp(1.0, std::numeric_limits<Stored>::digits);
    return value == std::floor(value) &&
      value >= static_cast<double>(std::numeric_limits<Stored>::min()) && value < end;
  }
}

// Stored -> Target without any arithmetic.
template <typename Stored, typename Target, bool Swap>
struct PlainConversion
{
  explicit PlainConversion(const SampleConversion&) noexcept {}
  Target operator()(const unsigned char* from) const noexcept
  {
    return static_cast<Target>(loadSample<Stored, Swap>(from));
  }
};

template <typename Stored, typename Target, bool Swap>
struct FullConversion
{
  explicit FullConversion(const SampleConversion& conversion) noexcept
    : Divisor(conversion.divisor)
    , HasIgnoreValue(conversion.hasIgnoreValue && isRepresentable<Stored>(conversion.ignoreValue))
    , IgnoreValue(HasIgnoreValue ? static_cast<Stored>(conversion.ignoreValue) : Stored{})
  {
  }
  Target operator()(const unsigned char* from) const noexcept
  {
    const auto value = loadSample<Stored, Swap>(from);
    return HasIgnoreValue && value == IgnoreValue
      ? std::numeric_limits<Target>::quiet_NaN()
      : static_cast<Target>(static_cast<double>(value) / Divisor);
  }
  double Divisor;
  bool HasIgnoreValue;
  Stored IgnoreValue;
};

// Bands that stand side by side in every pixel, as in the target.
bool isInterleaved(const std::vector<BandRow>& bands, std::size_t size) noexcept
{
  for (std::size_t b = 0; b < bands.size(); ++b)
  {
    if (bands[b].stride != static_cast<std::ptrdiff_t>(bands.size() * size) ||
      bands[b].samples != bands[0].samples + b * size)
    {
      return false;
    }
  }
  return true;
}

template <std::size_t Count, typename Target, typename Convert>
void interleaveBands(const BandRow* bands, std::size_t begin, std::size_t end,
  std::size_t pixelSize, const Convert& convert, Target* pixels) noexcept
{
  for (std::size_t x = begin; x < end; ++x)
  {
    Target* const to = pixels + x * pixelSize;
    for (std::size_t b = 0; b < Count; ++b)
    {
      to[b] = convert(bands[b].samples + static_cast<std::ptrdiff_t>(x) * bands[b].stride);
    }
  }
}

template <typename Stored, typename Target, typename Convert>
void interleaveTiles(const std::vector<BandRow>& bands, std::size_t width, const Convert& convert,
  Target* pixels) noexcept
{
  const std::size_t count = bands.size();
  if (isInterleaved(bands, sizeof(Stored)))
  {
    const unsigned char* from = bands[0].samples;
    for (std::size_t i = 0; i < width * count; ++i)
    {
      pixels[i] = convert(from + i * sizeof(Stored));
    }
    return;
  }
  const std::size_t tile = std::max<std::size_t>(TileValues / count, 8);
  for (std::size_t begin = 0; begin < width; begin += tile)
  {
    const std::size_t end = std::min(begin + tile, width);
    std::size_t b = 0;
    for (; b + BandsAtOnce <= count; b += BandsAtOnce)
    {
      interleaveBands<BandsAtOnce>(bands.data() + b, begin, end, count, convert, pixels + b);
    }
    for (; b < count; ++b)
    {
      interleaveBands<1>(bands.data() + b, begin, end, count, convert, pixels + b);
    }
  }
}

template <typename Target, bool Swap>
void interleave(SampleType stored, const std::vector<BandRow>& bands, std::size_t width,
  const SampleConversion& conversion, Target* pixels) noexcept
{
  withSampleType(stored,
    [&](auto value)
    {
      using Stored = decltype(value);
      if (conversion.divisor == 1.0 && !conversion.hasIgnoreValue)
      {
        interleaveTiles<Stored>(
          bands, width, PlainConversion<Stored, Target, Swap>(conversion), pixels);
      }
      else
      {
        interleaveTiles<Stored>(
          bands, width, FullConversion<Stored, Target, Swap>(conversion), pixels);
      }
    });
}

template <typename Target>
void interleaveEither(SampleType stored, const std::vector<BandRow>& bands, std::size_t width,
  const SampleConversion& conversion, Target* pixels) noexcept
{
  if (bands.empty())
  {
    return;
  }
  if (conversion.swapBytes && sampleSize(stored) > 1)
  {
    interleave<Target, true>(stored, bands, width, conversion, pixels);
  }
  else
  {
    interleave<Target, false>(stored, bands, width, conversion, pixels);
  }
}
}

void interleaveRow(SampleType stored, const std::vector<BandRow>& bands, std::size_t width,
  const SampleConversion& conversion, float* pixels) noexcept
{
  interleaveEither(stored, bands, width, conversion, pixels);
}

void interleaveRow(SampleType stored, const std::vector<BandRow>& bands, std::size_t width,
  const SampleConversion& conversion, double* pixels) noexcept
{
  interleaveEither(stored, bands, width, conversion, pixels);
}

} // namespace msi

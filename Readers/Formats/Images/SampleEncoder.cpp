#include "Formats/Images/SampleEncoder.h"

#include "Formats/Images/SampleTypes.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace msi
{

namespace
{
// The value as stored, or nothing where the type cannot hold it.
template <typename Stored>
std::optional<Stored> stored(double value)
{
  if constexpr (std::is_floating_point_v<Stored>)
  {
    return static_cast<Stored>(value);
  }
  else
  {
    const double whole = std::nearbyint(value);
    const double end = std::ldexp(1.0, std::numeric_limits<Stored>::digits);
    if (!(whole >= static_cast<double>(std::numeric_limits<Stored>::min()) && whole < end))
    {
      return std::nullopt;
    }
    return static_cast<Stored>(whole);
  }
}

template <typename Stored>
std::string reasonFor(double value, const SampleEncoding& encoding)
{
  if (std::isnan(value))
  {
    return std::string("NaN cannot be stored as ") + sampleTypeName(encoding.type) +
      " without a data ignore value";
  }
  return numberText(value) + " is outside of " + sampleTypeName(encoding.type) + ", " +
    std::to_string(std::numeric_limits<Stored>::min()) + " to " +
    std::to_string(std::numeric_limits<Stored>::max());
}

template <typename Value>
std::optional<std::string> encode(const SampleEncoding& encoding, const Value* values,
  std::ptrdiff_t valueStride, std::size_t count, unsigned char* samples,
  std::ptrdiff_t sampleStride)
{
  return withSampleType(encoding.type,
    [&](auto type) -> std::optional<std::string>
    {
      using Stored = decltype(type);
      for (std::size_t i = 0; i < count; ++i)
      {
        const auto at = static_cast<std::ptrdiff_t>(i);
        double value = static_cast<double>(values[at * valueStride]);
        value = std::isnan(value) && encoding.ignoreValue ? *encoding.ignoreValue
                                                          : value * encoding.factor;
        const auto sample = stored<Stored>(value);
        if (!sample)
        {
          return reasonFor<Stored>(value, encoding);
        }
        unsigned char* const to = samples + at * sampleStride;
        std::memcpy(to, &*sample, sizeof(Stored));
        if (encoding.swapBytes)
        {
          std::reverse(to, to + sizeof(Stored));
        }
      }
      return std::nullopt;
    });
}
}

std::optional<std::string> encodeSamples(const SampleEncoding& encoding, const float* values,
  std::ptrdiff_t valueStride, std::size_t count, unsigned char* samples,
  std::ptrdiff_t sampleStride)
{
  return encode(encoding, values, valueStride, count, samples, sampleStride);
}

std::optional<std::string> encodeSamples(const SampleEncoding& encoding, const double* values,
  std::ptrdiff_t valueStride, std::size_t count, unsigned char* samples,
  std::ptrdiff_t sampleStride)
{
  return encode(encoding, values, valueStride, count, samples, sampleStride);
}

} // namespace msi

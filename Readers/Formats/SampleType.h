// How one sample is stored.
#pragma once

#include <cstddef>

namespace msi
{

enum class SampleType
{
  UInt8,
  Int8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

// "uint16", "float32", ...
const char* sampleTypeName(SampleType type) noexcept;

std::size_t sampleSize(SampleType type) noexcept; // bytes

} // namespace msi

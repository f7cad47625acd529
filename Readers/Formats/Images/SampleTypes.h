// From a sample type known at run time to a type of the language.
#pragma once

#include "Formats/SampleType.h"

#include <cstdint>

namespace msi
{

// Calls action with a value of the type.
template <typename Action>
auto withSampleType(SampleType type, Action action)
{
  switch (type)
  {
    case SampleType::UInt8:
      return action(std::uint8_t{});
    case SampleType::Int8:
      return action(std::int8_t{});
    case SampleType::Int16:
      return action(std::int16_t{});
    case SampleType::UInt16:
      return action(std::uint16_t{});
    case SampleType::Int32:
      return action(std::int32_t{});
    case SampleType::UInt32:
      return action(std::uint32_t{});
    case SampleType::Int64:
      return action(std::int64_t{});
    case SampleType::UInt64:
      return action(std::uint64_t{});
    case SampleType::Float32:
      return action(float{});
    case SampleType::Float64:
      break;
  }
  return action(double{});
}

} // namespace msi

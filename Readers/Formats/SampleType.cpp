#include "Formats/SampleType.h"

#include "Formats/Images/SampleTypes.h"

namespace msi
{

const char* sampleTypeName(SampleType type) noexcept
{
  switch (type)
  {
    case SampleType::UInt8:
      return "uint8";
    case SampleType::Int8:
      return "int8";
    case SampleType::Int16:
      return "int16";
    case SampleType::UInt16:
      return "uint16";
    case SampleType::Int32:
      return "int32";
    case SampleType::UInt32:
      return "uint32";
    case SampleType::Int64:
      return "int64";
    case SampleType::UInt64:
      return "uint64";
    case SampleType::Float32:
      return "float32";
    case SampleType::Float64:
      break;
  }
  return "float64";
}

std::size_t sampleSize(SampleType type) noexcept
{
  return withSampleType(type, [](auto value) { return sizeof(value); });
}

} // namespace msi

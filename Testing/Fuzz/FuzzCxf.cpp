#include "FuzzTarget.h"

#include "Formats/Tables/CxfTable.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  parseOrRefuse(
    [&]
    {
      const auto samples = msi::parseCxf("f", textOf(data, size), msi::ReflectanceUnit::Recognize);
      require(samples.reflectance.array().isFinite().all());
    });
  return 0;
}

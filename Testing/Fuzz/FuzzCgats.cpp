#include "FuzzTarget.h"

#include "Formats/Tables/CgatsTable.h"
#include "Formats/Tables/SampleColumns.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  parseOrRefuse(
    [&]
    {
      const msi::TextTable table = msi::parseCgats("f", textOf(data, size));
      msi::samplesFromText(table, msi::ReflectanceUnit::Recognize);
    });
  return 0;
}

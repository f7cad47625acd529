#include "FuzzTarget.h"

#include "Formats/EffectList.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  parseOrRefuse([&] { msi::parseEffectList("f", textOf(data, size), { "C1", "C2", "C3" }); });
  return 0;
}

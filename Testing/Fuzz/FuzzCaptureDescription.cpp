#include "FuzzTarget.h"

#include "Formats/Capture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  parseOrRefuse([&] { msi::parseCaptureDescription("f", textOf(data, size)); });
  return 0;
}

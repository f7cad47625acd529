#include "FuzzTarget.h"

#include "Formats/Images/EnviHeader.h"

// What was read can be written, and reads back as the same image.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  parseOrRefuse(
    [&]
    {
      const msi::EnviHeader header = msi::parseEnviHeader("f", textOf(data, size));
      require(header.expectedFileSize() > 0);
      const msi::EnviHeader back = msi::parseEnviHeader("f", msi::enviHeaderText(header));
      require(back.expectedFileSize() == header.expectedFileSize());
      require(back.info.bands() == header.info.bands());
      require(back.info.wavelengths == header.info.wavelengths);
      require(back.info.displayBands == header.info.displayBands);
      require(back.interleave == header.interleave && back.type == header.type);
    });
  return 0;
}

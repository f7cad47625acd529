#include "MemoryFile.h"

#include "Formats/SampleTable.h"

// The whole reader: it finds the format from the content. HDF5 is fuzzed by its own project.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size > 3 && textOf(data, 4) == "\x89HDF")
  {
    return 0;
  }
  const MemoryFile file(data, size);
  parseOrRefuse(
    [&]
    {
      const msi::SampleTable table = msi::readSampleTable(file.path());
      require(table.reflectance.array().isFinite().all());
      require(table.responses.array().isFinite().all());
      require(!table.hasReflectance() || table.wavelengths->size() == table.reflectance.rows());
      require(!table.hasResponses() ||
        table.channelNames.size() == static_cast<std::size_t>(table.responses.rows()));
    });
  return 0;
}

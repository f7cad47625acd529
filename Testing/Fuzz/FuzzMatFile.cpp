#include "MemoryFile.h"

#include "Formats/Arrays/ArrayFile.h"

namespace
{
void readAll(const msi::ArrayFile& file)
{
  for (std::size_t i = 0; i < file.arrays().size(); ++i)
  {
    parseOrRefuse([&]
      { require(file.readAll(i).size() == static_cast<std::size_t>(file.arrays()[i].count())); });
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const MemoryFile file(data, size);
  parseOrRefuse([&] { readAll(*msi::openMat5File(file.path())); });
  parseOrRefuse([&] { readAll(*msi::openMat4File(file.path())); });
  return 0;
}

#include "FuzzTarget.h"

#include "Formats/Arrays/ArrayFile.h"

#include <sys/mman.h>
#include <unistd.h>

namespace
{
// The parsers of MAT files read at any place of a file: here of one in memory.
class MemoryFile
{
public:
  MemoryFile(const std::uint8_t* data, std::size_t size)
    : Descriptor(::memfd_create("fuzz", MFD_CLOEXEC))
  {
    require(Descriptor >= 0 && ::write(Descriptor, data, size) == static_cast<ssize_t>(size));
  }
  ~MemoryFile() { ::close(Descriptor); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(Descriptor); }

private:
  int Descriptor;
};

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

// A file in memory under a name, for readers that want one.
#pragma once

#include "FuzzTarget.h"

#include <sys/mman.h>
#include <unistd.h>

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

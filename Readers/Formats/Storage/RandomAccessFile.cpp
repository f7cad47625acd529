#include "Formats/Storage/RandomAccessFile.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/WholeFile.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace msi
{

RandomAccessFile::RandomAccessFile(std::string path)
  : Path(std::move(path))
{
  requireReadableFile(Path);
  Descriptor = ::open(Path.c_str(), O_RDONLY | O_CLOEXEC);
  if (Descriptor < 0)
  {
    throw FormatError(Path, std::string("cannot be read (") + std::strerror(errno) + ")",
      "a readable file", "check the name and the access rights");
  }
  Stamp.emplace(Descriptor);
}

RandomAccessFile::~RandomAccessFile()
{
  ::close(Descriptor);
}

void RandomAccessFile::read(std::int64_t offset, void* bytes, std::size_t count) const
{
  char* next = static_cast<char*>(bytes);
  while (count > 0)
  {
    const ssize_t got = ::pread(Descriptor, next, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got <= 0)
    {
      throw FormatError(Path,
        got < 0
          ? "cannot be read at offset " + std::to_string(offset) + " (" + std::strerror(errno) + ")"
          : "ends at offset " + std::to_string(offset),
        std::to_string(count) + " more bytes",
        "the file seems to have been cut off; copy it again");
    }
    next += got;
    offset += got;
    count -= static_cast<std::size_t>(got);
  }
  Stamp->requireUnchanged(Descriptor, Path);
}

} // namespace msi

#include "Formats/Storage/AtomicFile.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/StaleParts.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

namespace msi
{

namespace
{
constexpr mode_t AccessRights = 0666; // less the umask

[[noreturn]] void throwNotWritten(const std::string& path, const char* what, int reason)
{
  throw FormatError(path, std::string(what) + " (" + std::strerror(reason) + ")",
    "a writable folder with room in it", "check the folder, its access rights and the free space");
}

void syncFolderOf(const std::string& path)
{
  // The rename itself reaches the disk with the folder. Some file systems refuse this; the file is
  // complete all the same.
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor >= 0)
  {
    ::fsync(descriptor);
    ::close(descriptor);
  }
}
}

std::string temporaryNameBeside(const std::string& path)
{
  static std::atomic<unsigned> counter{ 0 };
  removeStaleParts(path);
  return partName(path, counter++);
}

void commitFile(const std::string& temporary, const std::string& path)
{
  const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    throwNotWritten(path, "was not written", errno);
  }
  const bool synced = ::fsync(descriptor) == 0;
  const int reason = errno;
  ::close(descriptor);
  if (!synced)
  {
    throwNotWritten(path, "could not be brought to the disk", reason);
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
  {
    throwNotWritten(path, "could not be replaced", errno);
  }
  syncFolderOf(path);
}

AtomicFile::AtomicFile(std::string path)
  : Path(std::move(path))
  , Temporary(temporaryNameBeside(Path))
  , Descriptor(::open(Temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, AccessRights))
{
  if (Descriptor < 0)
  {
    fail("cannot be written");
  }
}

AtomicFile::~AtomicFile()
{
  if (Descriptor >= 0)
  {
    ::close(Descriptor);
  }
  if (!Temporary.empty())
  {
    ::unlink(Temporary.c_str());
  }
}

void AtomicFile::fail(const char* what) const
{
  throwNotWritten(Path, what, errno);
}

void AtomicFile::append(const void* bytes, std::size_t count)
{
  const char* next = static_cast<const char*>(bytes);
  while (count > 0)
  {
    const ssize_t written = ::write(Descriptor, next, count);
    if (written < 0 && errno != EINTR)
    {
      fail("cannot be written");
    }
    if (written > 0)
    {
      next += written;
      count -= static_cast<std::size_t>(written);
    }
  }
}

void AtomicFile::writeAt(std::size_t offset, const void* bytes, std::size_t count)
{
  const char* next = static_cast<const char*>(bytes);
  while (count > 0)
  {
    const ssize_t written = ::pwrite(Descriptor, next, count, static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR)
    {
      fail("cannot be written");
    }
    if (written > 0)
    {
      next += written;
      offset += static_cast<std::size_t>(written);
      count -= static_cast<std::size_t>(written);
    }
  }
}

void AtomicFile::sync()
{
  if (::fsync(Descriptor) != 0)
  {
    fail("could not be brought to the disk");
  }
  const int closed = ::close(Descriptor);
  Descriptor = -1;
  if (closed != 0)
  {
    fail("could not be brought to the disk");
  }
}

void AtomicFile::commit()
{
  if (Descriptor >= 0)
  {
    sync();
  }
  if (std::rename(Temporary.c_str(), Path.c_str()) != 0)
  {
    fail("could not be replaced");
  }
  Temporary.clear();
  syncFolderOf(Path);
}

} // namespace msi

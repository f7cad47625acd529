#include "Formats/Storage/FileStamp.h"

#include "Formats/FormatError.h"

#include <sys/stat.h>

namespace msi
{

FileStamp::FileStamp(int descriptor) noexcept
{
  struct stat status = {};
  if (::fstat(descriptor, &status) == 0)
  {
    take(status);
  }
}

FileStamp::FileStamp(const std::string& path) noexcept
{
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0)
  {
    take(status);
  }
}

void FileStamp::take(const struct ::stat& status) noexcept
{
  Device = status.st_dev;
  Inode = status.st_ino;
  Size = status.st_size;
  Seconds = status.st_mtim.tv_sec;
  Nanoseconds = status.st_mtim.tv_nsec;
}

void FileStamp::requireUnchanged(int descriptor, const std::string& path) const
{
  requireSame(FileStamp(descriptor), path);
}

void FileStamp::requireUnchanged(const std::string& path) const
{
  const FileStamp now(path);
  if (now.Device == Device && now.Inode == Inode)
  {
    requireSame(now, path);
  }
}

void FileStamp::requireSame(const FileStamp& now, const std::string& path) const
{
  if (now.Size < Size)
  {
    throw FormatError(path,
      "holds " + std::to_string(now.Size) + " bytes, " + std::to_string(Size - now.Size) +
        " less than when it was opened",
      "a file that stays as it is", "the file was cut off meanwhile; copy it again");
  }
  if (now.Seconds != Seconds || now.Nanoseconds != Nanoseconds)
  {
    throw FormatError(path, "was written to while it was read", "a file that stays as it is",
      "wait until it is complete and read it again");
  }
}

} // namespace msi

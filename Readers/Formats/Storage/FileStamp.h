// Whether a file that stays open is still the one that was opened.
#pragma once

#include <cstdint>
#include <string>

struct stat;

namespace msi
{

// Size and time of change of an open file. Readers that keep a file open ask after every read: samples of a file that
// was cut off or written over meanwhile belong to no image, and some libraries give zeros for them.
class FileStamp
{
public:
  explicit FileStamp(int descriptor) noexcept;
  // Of a file that a library opens afterwards.
  explicit FileStamp(const std::string& path) noexcept;

  // Errors: FormatError naming 'path' where the file is not what it was. A file that was replaced by another one of
  // its name (renamed) is none of them: the open one stays whole.
  void requireUnchanged(int descriptor, const std::string& path) const;
  void requireUnchanged(const std::string& path) const;

  std::int64_t size() const noexcept { return Size; }

private:
  void take(const struct ::stat& status) noexcept;
  void requireSame(const FileStamp& now, const std::string& path) const;

  std::uint64_t Device = 0;
  std::uint64_t Inode = 0;
  std::int64_t Size = 0;
  std::int64_t Seconds = 0;
  std::int64_t Nanoseconds = 0;
};

} // namespace msi

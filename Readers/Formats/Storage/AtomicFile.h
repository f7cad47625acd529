// A file that is complete or absent.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace msi
{

// Writes to a hidden file beside 'path'; commit() brings the bytes to the disk (fsync) and renames. A file that is not
// committed is removed, also by the next one that is written beside it when this process was killed. Errors: FormatError naming 'path' and the system's reason.
class AtomicFile
{
public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void append(const void* bytes, std::size_t count);
  void append(std::string_view text) { append(text.data(), text.size()); }
  void writeAt(std::size_t offset, const void* bytes, std::size_t count);

  // Brings the bytes to the disk; nothing can be written after it.
  void sync();
  // sync(), then takes the name.
  void commit();

  const std::string& path() const noexcept { return Path; }
  const std::string& temporaryPath() const noexcept { return Temporary; }

private:
  [[noreturn]] void fail(const char* what) const;

  std::string Path;
  std::string Temporary;
  int Descriptor = -1;
};

// For writers of other libraries: a hidden name beside 'path', and the step that gives the finished
// file its name. What killed processes left of 'path' is removed.
std::string temporaryNameBeside(const std::string& path);
void commitFile(const std::string& temporary, const std::string& path);

} // namespace msi

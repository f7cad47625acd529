// Reads at any place of a large file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace msi
{

// Threads: read may be called from several threads. Not mapped into memory: a file that another
// program cuts off meanwhile gives an error here, and would end the process there.
class RandomAccessFile
{
public:
  // Errors: FormatError naming the file.
  explicit RandomAccessFile(std::string path);
  ~RandomAccessFile();
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;

  const std::string& path() const noexcept { return Path; }
  std::int64_t size() const noexcept { return Size; }

  // Exactly 'count' bytes from 'offset' on, or FormatError naming file and offset.
  void read(std::int64_t offset, void* bytes, std::size_t count) const;

private:
  std::string Path;
  int Descriptor = -1;
  std::int64_t Size = 0;
};

} // namespace msi

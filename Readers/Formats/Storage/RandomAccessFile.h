// Reads at any place of a large file.
#pragma once

#include "Formats/Storage/FileStamp.h"

#include <cstddef>
#include <cstdint>
#include <optional>
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
  std::int64_t size() const noexcept { return Stamp->size(); }

  // Exactly 'count' bytes from 'offset' on, or FormatError naming file and offset; also where the file was written to
  // since it was opened.
  void read(std::int64_t offset, void* bytes, std::size_t count) const;

private:
  std::string Path;
  int Descriptor = -1;
  std::optional<FileStamp> Stamp;
};

} // namespace msi

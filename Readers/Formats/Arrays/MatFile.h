// MAT files of level 4 and 5: the part that is common to both.
#pragma once

#include "Formats/Arrays/ArrayFile.h"
#include "Formats/Storage/RandomAccessFile.h"

#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace msi
{

// Where the samples of an array stand.
struct MatData
{
  std::int64_t offset = 0; // in the file, or in the inflated element
  bool compressed = false;
  std::int64_t elementOffset = 0; // of the compressed element
  std::int64_t elementSize = 0;
};

class MatFile : public ArrayFile
{
public:
  // Arrays that are not compressed are read from the file part by part; compressed ones are inflated as
  // a whole and kept, the fields of a structure together.
  void read(
    std::size_t array, const ArrayPart& part, std::vector<unsigned char>& bytes) const override;

protected:
  explicit MatFile(const std::string& path);

  void add(NamedArray array, const MatData& data);
  // Throws FormatError unless [offset, offset + size) lies within the file.
  void requireInside(std::int64_t offset, std::int64_t size) const;
  [[noreturn]] void failAt(std::int64_t offset, const std::string& what) const;
  void noteLeftOut();

  RandomAccessFile File;
  bool SwapBytes = false;
  int LeftOut = 0; // variables, and fields of structures, that are no arrays of real numbers

private:
  const std::vector<unsigned char>& inflated(std::size_t array) const;

  std::vector<MatData> Data;
  mutable std::mutex Mutex;
  mutable std::map<std::int64_t, std::vector<unsigned char>> Inflated; // by place of the element
};

// At most 'most' bytes of a zlib stream; fewer where it ends before. Nothing where it is damaged.
bool inflateBytes(
  const std::vector<unsigned char>& stream, std::size_t most, std::vector<unsigned char>& bytes);

} // namespace msi

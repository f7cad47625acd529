// Files of named arrays: MAT (level 4, 5 and 7.3) and HDF5.
#pragma once

#include "Formats/SampleType.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace msi
{

// An array of numbers or characters. The shape has the slowest axis first, as HDF5 and C have it; a
// MATLAB matrix of R x C x B therefore is B, C, R here.
struct NamedArray
{
  std::string name;
  std::vector<std::int64_t> shape;
  SampleType type;
  bool isText = false;

  std::int64_t count() const noexcept;
};

// Part of an array: 'size' elements from 'start' on, along each axis.
struct ArrayPart
{
  std::vector<std::int64_t> start;
  std::vector<std::int64_t> size;
};

// Threads: read may be called from several threads; one at a time reads.
class ArrayFile
{
public:
  virtual ~ArrayFile() = default;
  ArrayFile(const ArrayFile&) = delete;
  ArrayFile& operator=(const ArrayFile&) = delete;

  const std::string& path() const noexcept { return Path; }
  const std::vector<NamedArray>& arrays() const noexcept { return Arrays; }
  // Short vectors of numbers that are attributes of arrays and groups (HDF5), "cube.wavelengths".
  const std::vector<std::pair<std::string, std::vector<double>>>& attributes() const noexcept
  {
    return Attributes;
  }
  // MATLAB wrote it: the fastest axis counts rows.
  bool isMatlab() const noexcept { return Matlab; }
  // What the file holds besides: "2 variables were left out".
  const std::vector<std::string>& notes() const noexcept { return Notes; }

  // The samples in the byte order of the machine. Errors: FormatError naming file and array.
  virtual void read(
    std::size_t array, const ArrayPart& part, std::vector<unsigned char>& bytes) const = 0;

  // All values, as doubles.
  std::vector<double> readAll(std::size_t array) const;
  // The array of that name. Errors: FormatError listing the names there are.
  std::size_t require(const std::string& name) const;
  // "munsell (31 x 32), C (16 x 32)", axes in the order of the program that wrote the file; of these arrays, or all.
  std::string listing(const std::vector<std::size_t>& which) const;
  std::string listing() const;
  std::string shapeText(const NamedArray& array) const;

protected:
  explicit ArrayFile(std::string path);

  std::string Path;
  std::vector<NamedArray> Arrays;
  std::vector<std::pair<std::string, std::vector<double>>> Attributes;
  std::vector<std::string> Notes;
  bool Matlab = false;
};

// Level 4 has no signature: true where the first bytes are the header of a variable with a name.
bool looksLikeMat4(std::string_view beginning) noexcept;
bool looksLikeMat5(std::string_view beginning) noexcept;
// The signature at one of the places where HDF5 allows it, as far as 'beginning' reaches.
bool looksLikeHdf5(std::string_view beginning) noexcept;
constexpr std::size_t ArrayFileBeginning = 2048 + 8;

// Errors: FormatError for damaged files and files without any array of numbers.
//
// Why not MatIO for level 4 and 5: version 1.5.23 reads a file that was cut off as if it were whole.
std::unique_ptr<ArrayFile> openMat4File(const std::string& path);
std::unique_ptr<ArrayFile> openMat5File(const std::string& path);
std::unique_ptr<ArrayFile> openHdf5File(const std::string& path);
// By content. Nothing for other files.
std::unique_ptr<ArrayFile> openArrayFile(const std::string& path);

} // namespace msi

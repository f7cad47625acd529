#include "Formats/Arrays/MatFile.h"

#include <array>
#include <cstring>
#include <optional>
#include <utility>

namespace msi
{

namespace
{
constexpr std::size_t HeaderSize = 20;
constexpr std::int64_t LongestName = 256;
constexpr std::array<SampleType, 6> Types = { SampleType::Float64, SampleType::Float32,
  SampleType::Int32, SampleType::Int16, SampleType::UInt16, SampleType::UInt8 };

// MOPT, rows, columns, imaginary flag, length of the name.
struct Header
{
  std::uint32_t kind;
  std::int64_t rows;
  std::int64_t columns;
  bool complex;
  std::int64_t nameLength;
  bool bigEndian;

  unsigned machine() const { return kind / 1000; }
  unsigned precision() const { return kind / 10 % 10; }
  unsigned matrix() const { return kind % 10; } // full, text, sparse
};

std::uint32_t word(const unsigned char* bytes, bool bigEndian)
{
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i)
  {
    value = value << 8 | bytes[bigEndian ? i : 3 - i];
  }
  return value;
}

// Nothing where the bytes are no header of level 4; there is no signature.
std::optional<Header> parseHeader(const unsigned char* bytes)
{
  for (const bool bigEndian : { false, true })
  {
    const Header header{ word(bytes, bigEndian), word(bytes + 4, bigEndian),
      word(bytes + 8, bigEndian), word(bytes + 12, bigEndian) == 1, word(bytes + 16, bigEndian),
      bigEndian };
    const bool isKind = header.kind < 2000 && header.machine() == (bigEndian ? 1u : 0u) &&
      header.kind / 100 % 10 == 0 && header.precision() < Types.size() && header.matrix() <= 2;
    if (isKind && word(bytes + 12, bigEndian) <= 1 && header.nameLength >= 1 &&
      header.nameLength <= LongestName)
    {
      return header;
    }
  }
  return std::nullopt;
}

// Source: The MathWorks, "MAT-File Format", section "Level 4 MAT-File Format".
class Mat4File final : public MatFile
{
public:
  explicit Mat4File(const std::string& path)
    : MatFile(path)
  {
    for (std::int64_t at = 0; at < File.size();)
    {
      at = addVariable(at);
    }
    noteLeftOut();
  }

private:
  // Returns where the next one begins.
  std::int64_t addVariable(std::int64_t at)
  {
    std::array<unsigned char, HeaderSize> bytes{};
    requireInside(at, HeaderSize);
    File.read(at, bytes.data(), bytes.size());
    const auto header = parseHeader(bytes.data());
    if (!header || (at > 0 && header->bigEndian != SwapBytes))
    {
      failAt(at, "no header of a variable stands");
    }
    SwapBytes = header->bigEndian; // the machine is little endian
    std::string name(static_cast<std::size_t>(header->nameLength), '\0');
    requireInside(at + static_cast<std::int64_t>(HeaderSize), header->nameLength);
    File.read(at + static_cast<std::int64_t>(HeaderSize), name.data(), name.size());
    name.resize(std::strlen(name.c_str()));

    const SampleType type = Types[header->precision()];
    const std::int64_t data = at + static_cast<std::int64_t>(HeaderSize) + header->nameLength;
    // Both are below 2^32, so that the product of the first two and 16 bytes may not fit.
    const std::int64_t most = File.size();
    if (header->columns > 0 && header->rows > most / header->columns)
    {
      failAt(at, "variable '" + name + "' is larger than the file, which it says");
    }
    const std::int64_t count = header->rows * header->columns;
    const std::int64_t size =
      count * static_cast<std::int64_t>(sampleSize(type)) * (header->complex ? 2 : 1);
    requireInside(data, size);
    if (header->matrix() == 2 || header->complex || count == 0)
    {
      ++LeftOut;
    }
    else
    {
      add({ name, { header->columns, header->rows }, type, header->matrix() == 1 },
        { data, false, 0, 0 });
    }
    return data + size;
  }
};
}

bool looksLikeMat4(std::string_view beginning) noexcept
{
  if (beginning.size() <= HeaderSize)
  {
    return false;
  }
  std::array<unsigned char, HeaderSize> bytes{};
  std::memcpy(bytes.data(), beginning.data(), bytes.size());
  const auto header = parseHeader(bytes.data());
  const unsigned char first = static_cast<unsigned char>(beginning[HeaderSize]);
  return header && ((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z'));
}

std::unique_ptr<ArrayFile> openMat4File(const std::string& path)
{
  return std::make_unique<Mat4File>(path);
}

} // namespace msi

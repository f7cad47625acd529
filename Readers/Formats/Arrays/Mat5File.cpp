#include "Formats/Arrays/MatFile.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

namespace msi
{

namespace
{
constexpr std::int64_t FileHeaderSize = 128;
constexpr std::size_t TagSize = 8;
constexpr std::size_t HeadSize =
  4096; // flags, shape and name of a variable and the tag of its data
constexpr std::uint32_t Matrix = 14;
constexpr std::uint32_t Compressed = 15;
constexpr std::uint32_t LongestName = 1024;
constexpr std::uint32_t MostAxes = 32;
constexpr std::uint32_t ComplexFlag = 0x800;

enum ArrayClass : std::uint32_t
{
  CharClass = 4,
  DoubleClass = 6,
  UInt64Class = 15
};

std::optional<SampleType> sampleTypeOf(std::uint32_t code)
{
  switch (code)
  {
    case 1:
      return SampleType::Int8;
    case 2:
    case 16: // UTF-8
      return SampleType::UInt8;
    case 3:
      return SampleType::Int16;
    case 4:
    case 17: // UTF-16
      return SampleType::UInt16;
    case 5:
      return SampleType::Int32;
    case 6:
      return SampleType::UInt32;
    case 7:
      return SampleType::Float32;
    case 9:
      return SampleType::Float64;
    case 12:
      return SampleType::Int64;
    case 13:
      return SampleType::UInt64;
    default:
      return std::nullopt;
  }
}

struct Tag
{
  std::uint32_t type;
  std::uint32_t size;
  std::size_t data; // where the data begin
  std::size_t next; // where the next tag begins
};

// The elements at the beginning of a variable, as far as 'bytes' reach.
class ElementReader
{
public:
  ElementReader(const std::vector<unsigned char>& bytes, bool swap)
    : Bytes(bytes)
    , Swap(swap)
  {
  }

  std::uint32_t word(std::size_t at) const
  {
    std::uint32_t value = 0;
    std::memcpy(&value, Bytes.data() + at, sizeof(value));
    return Swap ? __builtin_bswap32(value) : value;
  }

  // Nothing where the tag does not lie within the bytes.
  std::optional<Tag> tagAt(std::size_t at) const
  {
    if (at + TagSize > Bytes.size())
    {
      return std::nullopt;
    }
    const std::uint32_t first = word(at);
    if (first >> 16 != 0) // up to four bytes stand within the tag itself
    {
      return Tag{ first & 0xFFFF, std::min<std::uint32_t>(first >> 16, 4), at + 4, at + TagSize };
    }
    const std::uint32_t size = word(at + 4);
    const std::size_t padded = (std::size_t{ size } + 7) / 8 * 8;
    return Tag{ first, size, at + TagSize, at + TagSize + padded };
  }

  // The tag, if all of its data lie within the bytes too.
  std::optional<Tag> wholeAt(std::size_t at) const
  {
    const auto tag = tagAt(at);
    return tag && tag->data + tag->size <= Bytes.size() ? tag : std::nullopt;
  }

private:
  const std::vector<unsigned char>& Bytes;
  bool Swap;
};

// Source: The MathWorks, "MAT-File Format", section "Level 5 MAT-File Format".
class Mat5File final : public MatFile
{
public:
  explicit Mat5File(const std::string& path)
    : MatFile(path)
  {
    std::vector<unsigned char> header(static_cast<std::size_t>(FileHeaderSize));
    requireInside(0, FileHeaderSize);
    File.read(0, header.data(), header.size());
    if (header[126] == 'M' && header[127] == 'I')
    {
      SwapBytes = true;
    }
    else if (header[126] != 'I' || header[127] != 'M')
    {
      failAt(126, "no byte order mark stands");
    }
    for (std::int64_t at = FileHeaderSize; at < File.size();)
    {
      at = addVariable(at);
    }
    noteLeftOut();
  }

private:
  std::vector<unsigned char> bytesAt(std::int64_t at, std::int64_t count) const
  {
    std::vector<unsigned char> bytes(static_cast<std::size_t>(count));
    File.read(at, bytes.data(), bytes.size());
    return bytes;
  }

  // Returns where the next one begins.
  std::int64_t addVariable(std::int64_t at)
  {
    requireInside(at, TagSize);
    const auto tagBytes = bytesAt(at, TagSize);
    const ElementReader reader(tagBytes, SwapBytes);
    const std::uint32_t type = reader.word(0);
    const std::int64_t size = reader.word(4);
    const std::int64_t data = at + static_cast<std::int64_t>(TagSize);
    requireInside(data, size);
    if (type == Matrix)
    {
      const auto head = bytesAt(at, std::min<std::int64_t>(size + 8, HeadSize));
      describe(head, at, { at, false, 0, 0 }, size + 8);
    }
    else if (type == Compressed)
    {
      describeCompressed(data, size);
    }
    else
    {
      ++LeftOut;
    }
    return data + size;
  }

  void describeCompressed(std::int64_t data, std::int64_t size)
  {
    // The head is inflated from as many bytes as it may take at the worst ratio.
    const auto stream = bytesAt(data, std::min<std::int64_t>(size, 2 * HeadSize));
    std::vector<unsigned char> head;
    if (!inflateBytes(stream, HeadSize, head) && head.size() < TagSize)
    {
      failAt(data, "a compressed variable cannot be inflated");
    }
    const ElementReader reader(head, SwapBytes);
    if (head.size() < TagSize || reader.word(0) != Matrix)
    {
      ++LeftOut;
      return;
    }
    describe(head, data, { 0, true, data, size },
      std::int64_t{ reader.word(4) } + static_cast<std::int64_t>(TagSize));
  }

  // 'head' begins with the tag of the variable, which 'length' bytes belong to. 'where' says from where
  // the offsets of 'data' count.
  void describe(
    const std::vector<unsigned char>& head, std::int64_t where, MatData data, std::int64_t length)
  {
    const ElementReader reader(head, SwapBytes);
    const auto flags = reader.wholeAt(TagSize);
    const auto shape = flags ? reader.wholeAt(flags->next) : std::nullopt;
    const auto name = shape ? reader.wholeAt(shape->next) : std::nullopt;
    const auto values = name ? reader.tagAt(name->next) : std::nullopt;
    if (!flags || flags->size < 8)
    {
      failAt(where, "the flags of a variable are missing");
    }
    const std::uint32_t kind = reader.word(flags->data) & 0xFF;
    const bool isNumeric = kind >= DoubleClass && kind <= UInt64Class;
    if ((!isNumeric && kind != CharClass) || (reader.word(flags->data) & ComplexFlag) != 0)
    {
      ++LeftOut;
      return;
    }
    if (!shape || !name || !values || shape->size % 4 != 0 || shape->size / 4 < 2 ||
      shape->size / 4 > MostAxes || name->size > LongestName)
    {
      failAt(where, "the description of a variable is damaged");
    }
    NamedArray array{ std::string(
                        reinterpret_cast<const char*>(head.data()) + name->data, name->size),
      shapeAt(reader, *shape), SampleType::UInt8, kind == CharClass };
    addValues(std::move(array), *values, where, data, length);
  }

  static std::vector<std::int64_t> shapeAt(const ElementReader& reader, const Tag& tag)
  {
    std::vector<std::int64_t> shape;
    for (std::size_t axis = tag.size / 4; axis-- > 0;)
    {
      shape.push_back(reader.word(tag.data + 4 * axis));
    }
    return shape;
  }

  void addValues(
    NamedArray array, const Tag& values, std::int64_t where, MatData data, std::int64_t length)
  {
    std::int64_t count = 1;
    for (const std::int64_t axis : array.shape)
    {
      if (axis == 0)
      {
        ++LeftOut;
        return;
      }
      if (count > length / axis)
      {
        failAt(where, "variable '" + array.name + "' is larger than its element, which stands");
      }
      count *= axis;
    }
    const auto type = sampleTypeOf(values.type);
    array.type = type.value_or(SampleType::UInt8);
    const std::int64_t bytes = count * static_cast<std::int64_t>(sampleSize(array.type));
    data.offset += static_cast<std::int64_t>(values.data);
    if (!type || bytes > values.size || static_cast<std::int64_t>(values.data) + bytes > length)
    {
      failAt(where,
        "variable '" + array.name + "' has fewer values than its shape asks for, which stands");
    }
    add(std::move(array), data);
  }
};
}

std::unique_ptr<ArrayFile> openMat5File(const std::string& path)
{
  return std::make_unique<Mat5File>(path);
}

} // namespace msi

#include "Formats/Arrays/Mat5Elements.h"
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
constexpr std::size_t HeadSize =
  4096; // flags, shape and name of a variable and the tag of its data
constexpr std::uint32_t Matrix = 14;
constexpr std::uint32_t Compressed = 15;
constexpr std::uint32_t LongestVariableName = 1024;
constexpr std::uint32_t MostAxes = 32;
constexpr std::uint32_t ClassMask = 0xFF;
constexpr std::uint32_t ComplexFlag = 0x800;

constexpr int DeepestStructure = 8;

enum ArrayClass : std::uint32_t
{
  StructureClass = 2,
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
      Element element{ {}, { at, false, 0, 0 }, size + 8, nullptr };
      describe(element);
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
    const std::int64_t length = std::int64_t{ reader.word(4) } + static_cast<std::int64_t>(TagSize);
    Element element{ {}, { 0, true, data, size }, length, &head };
    if ((flagsOf(element) & ClassMask) == StructureClass)
    {
      const auto all = bytesAt(data, size);
      if (!inflateBytes(all, static_cast<std::size_t>(length), head))
      {
        failAt(data, "a compressed structure cannot be inflated");
      }
    }
    describe(element);
  }

  // A variable or a field of a structure, from its tag on.
  struct Element
  {
    std::string
      name;       // of a field, with those of the structures around it; empty: as the element says
    MatData data; // 'offset' is where it begins, in the file or in the inflated bytes
    std::int64_t length;
    const std::vector<unsigned char>* inflated; // all of the compressed variable, or its beginning
  };

  std::int64_t placeOf(const Element& element) const
  {
    return element.data.compressed ? element.data.elementOffset : element.data.offset;
  }

  // The beginning of an element, or a part of it 'from' there; fewer bytes at its end.
  std::vector<unsigned char> beginningOf(const Element& element, std::int64_t from = 0) const
  {
    const std::int64_t count =
      std::min<std::int64_t>(element.length - from, static_cast<std::int64_t>(HeadSize));
    if (count <= 0)
    {
      return {};
    }
    const std::int64_t begin = element.data.offset + from;
    if (element.inflated == nullptr)
    {
      return bytesAt(begin, count);
    }
    const auto end = static_cast<std::int64_t>(element.inflated->size());
    return { element.inflated->begin() + std::min(begin, end),
      element.inflated->begin() + std::min(begin + count, end) };
  }

  std::uint32_t flagsOf(const Element& element) const
  {
    const auto head = beginningOf(element);
    const ElementReader reader(head, SwapBytes);
    const auto flags = reader.wholeAt(TagSize);
    if (!flags || flags->size < 8)
    {
      failAt(placeOf(element), "the flags of a variable are missing");
    }
    return reader.word(flags->data);
  }

  struct Description
  {
    Tag shape;
    Tag name;
    Tag values; // or the length of the names of a structure's fields
  };

  static std::optional<Description> descriptionOf(const ElementReader& reader)
  {
    const auto flags = reader.wholeAt(TagSize);
    const auto shape = flags ? reader.wholeAt(flags->next) : std::nullopt;
    const auto name = shape ? reader.wholeAt(shape->next) : std::nullopt;
    const auto values = name ? reader.tagAt(name->next) : std::nullopt;
    if (!values || shape->size % 4 != 0 || shape->size / 4 < 2 || shape->size / 4 > MostAxes ||
      name->size > LongestVariableName)
    {
      return std::nullopt;
    }
    return Description{ *shape, *name, *values };
  }

  void describe(const Element& element, int depth = 0)
  {
    const std::uint32_t flags = flagsOf(element);
    const std::uint32_t kind = flags & ClassMask;
    const bool isNumeric = kind >= DoubleClass && kind <= UInt64Class;
    if ((!isNumeric && kind != CharClass && kind != StructureClass) || (flags & ComplexFlag) != 0 ||
      depth > DeepestStructure)
    {
      ++LeftOut;
      return;
    }
    const auto head = beginningOf(element);
    const ElementReader reader(head, SwapBytes);
    const auto description = descriptionOf(reader);
    if (!description)
    {
      failAt(placeOf(element), "the description of a variable is damaged");
    }
    const Tag name = description->name;
    const std::string known = element.name.empty()
      ? std::string(reinterpret_cast<const char*>(head.data()) + name.data, name.size)
      : element.name;
    const auto axes = shapeAt(reader, description->shape);
    if (kind != StructureClass)
    {
      addValues(
        { known, axes, SampleType::UInt8, kind == CharClass }, description->values, element);
    }
    else if (std::all_of(axes.begin(), axes.end(), [](std::int64_t axis) { return axis == 1; }))
    {
      describeFields(element, known, static_cast<std::int64_t>(name.next), depth);
    }
    else
    {
      ++LeftOut;
    }
  }

  // The length of the names, all names padded to it, and one element a field.
  void describeFields(const Element& structure, const std::string& name, std::int64_t at, int depth)
  {
    const auto head = beginningOf(structure, at);
    const ElementReader reader(head, SwapBytes);
    const auto lengthTag = reader.wholeAt(0);
    const auto names = lengthTag ? reader.wholeAt(lengthTag->next) : std::nullopt;
    const std::uint32_t length =
      lengthTag && lengthTag->size == 4 ? reader.word(lengthTag->data) : 0;
    if (!names || length == 0 || names->size % length != 0)
    {
      failAt(placeOf(structure), "the fields of structure '" + name + "' are damaged, or too many");
    }
    at += static_cast<std::int64_t>(names->next);
    for (std::uint32_t field = 0; field < names->size / length; ++field)
    {
      const auto bytes = beginningOf(structure, at);
      const ElementReader tag(bytes, SwapBytes);
      const std::int64_t size = bytes.size() < TagSize
        ? structure.length
        : std::int64_t{ tag.word(4) } + static_cast<std::int64_t>(TagSize);
      if (size > structure.length - at || tag.word(0) != Matrix)
      {
        failAt(placeOf(structure), "the fields of structure '" + name + "' are damaged");
      }
      const char* text =
        reinterpret_cast<const char*>(head.data()) + names->data + std::size_t{ field } * length;
      if (size > static_cast<std::int64_t>(TagSize)) // else it is empty
      {
        Element element = structure;
        element.name = name + "." + std::string(text, ::strnlen(text, length));
        element.data.offset += at;
        element.length = size;
        describe(element, depth + 1);
      }
      at += size;
    }
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

  void addValues(NamedArray array, const Tag& values, const Element& element)
  {
    const std::int64_t where = placeOf(element);
    std::int64_t count = 1;
    for (const std::int64_t axis : array.shape)
    {
      if (axis == 0)
      {
        ++LeftOut;
        return;
      }
      if (count > element.length / axis)
      {
        failAt(where, "variable '" + array.name + "' is larger than its element, which stands");
      }
      count *= axis;
    }
    const auto type = sampleTypeOf(values.type);
    array.type = type.value_or(SampleType::UInt8);
    const std::int64_t bytes = count * static_cast<std::int64_t>(sampleSize(array.type));
    MatData data = element.data;
    data.offset += static_cast<std::int64_t>(values.data);
    if (!type || bytes > values.size ||
      static_cast<std::int64_t>(values.data) + bytes > element.length)
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

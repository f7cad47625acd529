// The elements of a MAT file of level 5: tags and what they frame.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

namespace msi
{

constexpr std::size_t TagSize = 8;

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

} // namespace msi

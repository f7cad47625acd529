#include "Formats/Text/TextPlace.h"

#include <algorithm>

namespace msi
{

FilePlace placeOfOffset(const std::string& file, const std::string& text, std::size_t offset)
{
  const std::size_t at = std::min(offset, text.size());
  const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t begin = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return { file, lines + 1,
    static_cast<std::int64_t>(begin == std::string::npos ? at + 1 : at - begin) };
}

} // namespace msi

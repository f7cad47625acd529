#pragma once

#include <cstddef>
#include <string>

namespace msi
{

// "1 sample", "2 samples": for nouns whose plural has an s.
inline std::string counted(std::ptrdiff_t count, const char* noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

} // namespace msi

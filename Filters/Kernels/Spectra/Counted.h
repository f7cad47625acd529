#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace msi
{

// "1 sample", "2 samples": for nouns whose plural has an s.
inline std::string counted(std::ptrdiff_t count, const char* noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// "a, b and c"
inline std::string listed(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  }
  return text;
}

// The first few of many.
inline std::string listedFew(std::vector<std::string> names, std::size_t most = 5)
{
  if (names.size() > most + 1)
  {
    const std::size_t others = names.size() - most;
    names.resize(most);
    names.push_back(std::to_string(others) + " others");
  }
  return listed(names);
}

} // namespace msi

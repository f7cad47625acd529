#include "NameList.h"

#include <algorithm>
#include <sstream>

namespace msi
{

std::vector<std::string> namesIn(const std::string& list)
{
  std::string plain = list;
  std::replace(plain.begin(), plain.end(), ',', ' ');
  std::istringstream words(plain);
  std::vector<std::string> names;
  for (std::string name; words >> name;)
  {
    names.push_back(name);
  }
  return names;
}

std::vector<ErrorName> errorNames(const std::vector<std::string>& illuminants)
{
  std::vector<ErrorName> names{ { "rms", "" } };
  for (const auto& illuminant : illuminants)
  {
    names.push_back({ "dE00", illuminant });
  }
  return names;
}

} // namespace msi

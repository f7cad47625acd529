#include "Formats/Images/StackFiles.h"

#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

bool isOneOf(char c, std::string_view characters)
{
  return characters.find(c) != std::string_view::npos;
}

// The name with its wavelength replaced by a star; empty where it holds none, or several.
std::string patternOf(const std::string& name)
{
  const auto wavelengths = fileNameWavelengths(name);
  if (wavelengths.size() != 1 || !wavelengths[0].hasUnit)
  {
    return {};
  }
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (auto unit = lower.find("nm"); unit != std::string::npos; unit = lower.find("nm", unit + 1))
  {
    auto end = unit;
    while (end > 0 && isOneOf(lower[end - 1], "_- "))
    {
      --end;
    }
    auto begin = end;
    while (begin > 0 && isOneOf(lower[begin - 1], "0123456789.,"))
    {
      --begin;
    }
    if (begin < end)
    {
      return name.substr(0, begin) + "*" + name.substr(end);
    }
  }
  return {};
}
}

StackFiles stackOf(const std::string& file)
{
  const fs::path path(file);
  const std::string pattern = patternOf(path.filename().string());
  if (pattern.empty())
  {
    return {};
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::pair<double, std::string>> found;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    std::error_code unknown;
    if (patternOf(name) == pattern && entry->is_regular_file(unknown))
    {
      // As the caller wrote it: relative names stay relative.
      found.emplace_back(
        fileNameWavelengths(name)[0].nanometres, (path.parent_path() / name).string());
    }
  }
  if (found.size() < 2)
  {
    return {};
  }
  std::sort(found.begin(), found.end());
  StackFiles stack{ pattern, {} };
  stack.files.reserve(found.size());
  for (auto& [nanometres, name] : found)
  {
    stack.files.push_back(std::move(name));
  }
  return stack;
}

} // namespace msi

#include "Formats/Images/StackFiles.h"

#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

// The name with its wavelength replaced by a star; empty where it holds none, or several.
std::string patternOf(std::string name)
{
  const auto wavelengths = fileNameWavelengths(name);
  if (wavelengths.size() != 1 || !wavelengths[0].hasUnit)
  {
    return {};
  }
  return name.replace(wavelengths[0].begin, wavelengths[0].end - wavelengths[0].begin, "*");
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

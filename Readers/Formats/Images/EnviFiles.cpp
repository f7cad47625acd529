#include "Formats/Images/EnviImage.h"

#include "Formats/FormatError.h"
#include "Formats/Images/EnviHeader.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <vector>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t BeginningSize = 8;
constexpr std::array<const char*, 8> DataExtensions = { ".img", ".dat", ".raw", ".bil", ".bsq",
  ".bip", ".bin", ".cube" };

bool isFile(const std::string& path)
{
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool isHeader(const std::string& path)
{
  return looksLikeEnviHeader(readFileBeginning(path, BeginningSize));
}

bool hasHeaderExtension(const std::string& path)
{
  return lowerCase(fs::path(path).extension().string()) == ".hdr";
}

bool hasDataExtension(const std::string& path)
{
  const std::string extension = lowerCase(fs::path(path).extension().string());
  return std::find(DataExtensions.begin(), DataExtensions.end(), extension) != DataExtensions.end();
}

std::string withoutExtension(const std::string& path)
{
  return fs::path(path).replace_extension().string();
}

// NAME.img for NAME.hdr or NAME.img.hdr; the first of the known names that exists.
std::string dataFileOf(const std::string& header)
{
  std::string stem = withoutExtension(header);
  if (isFile(stem))
  {
    return stem;
  }
  for (const char* extension : DataExtensions)
  {
    std::string upper = extension;
    for (char& c : upper)
    {
      c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    for (const std::string& candidate : { stem + extension, stem + upper })
    {
      if (isFile(candidate))
      {
        return candidate;
      }
    }
  }
  const std::string name = fs::path(stem).filename().string();
  throw FormatError(header, "has no data file beside it",
    name + " or " + name + " with .img, .dat, .raw, .bil, .bsq, .bip, .bin or .cube",
    "put the data file beside the header");
}
}

std::optional<EnviFiles> findEnviFiles(const std::string& path)
{
  if (isHeader(path))
  {
    if (!hasHeaderExtension(path))
    {
      throw FormatError(path, "is an ENVI header without the extension .hdr",
        "a header named like its data file, with .hdr", "rename the header");
    }
    return EnviFiles{ path, dataFileOf(path) };
  }
  for (const std::string& stem : { path, withoutExtension(path) })
  {
    for (const char* extension : { ".hdr", ".HDR", ".Hdr" })
    {
      const std::string candidate = stem + extension;
      if (candidate != path && isFile(candidate) && isHeader(candidate))
      {
        return EnviFiles{ candidate, path };
      }
    }
  }
  if (hasHeaderExtension(path) && readFileBeginning(path, 2) != "#?") // not a Radiance picture
  {
    parseEnviHeader(path, readTextFile(path, "an ENVI header")); // says what is wrong with it
  }
  if (hasDataExtension(path))
  {
    const std::string name = fs::path(path).filename().string();
    throw FormatError(path, "has no header beside it",
      name + ".hdr or " + withoutExtension(name) + ".hdr",
      "put the ENVI header beside the data file");
  }
  return std::nullopt;
}

bool isEnviName(const std::string& path)
{
  return !fs::path(path).has_extension() || hasHeaderExtension(path) || hasDataExtension(path);
}

EnviFiles enviFilesToWrite(const std::string& path)
{
  if (hasHeaderExtension(path))
  {
    return { path, withoutExtension(path) + ".img" };
  }
  if (!fs::path(path).has_extension())
  {
    return { path + ".hdr", path + ".img" };
  }
  return { (hasDataExtension(path) ? withoutExtension(path) : path) + ".hdr", path };
}

} // namespace msi

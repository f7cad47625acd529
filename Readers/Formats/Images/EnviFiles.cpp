#include "Formats/Images/EnviImage.h"

#include "Formats/FormatError.h"
#include "Formats/Images/EnviHeader.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/TextEncoding.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t BeginningSize = 16; // of UTF-16 too
constexpr std::array<const char*, 9> DataExtensions = { ".img", ".dat", ".raw", ".bil", ".bsq",
  ".bip", ".bin", ".cube", ".sli" };

bool isFile(const std::string& path)
{
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool isHeader(const std::string& path)
{
  return looksLikeEnviHeader(asUtf8(readFileBeginning(path, BeginningSize)).value_or(""));
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

// STEM with any other extension, but that of a header, a picture, a text or a table: makers have their own (.hyspex).
std::vector<std::string> filesNamed(const std::string& stem)
{
  static constexpr std::array<std::string_view, 14> Others = { ".hdr", ".png", ".jpg", ".jpeg",
    ".tif", ".tiff", ".bmp", ".txt", ".log", ".xml", ".json", ".csv", ".pdf", ".enp" };
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator entry(
         fs::path(stem).parent_path().empty() ? fs::path(".") : fs::path(stem).parent_path(),
         error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
  {
    const std::string path = (fs::path(stem).parent_path() / entry->path().filename()).string();
    const std::string extension = lowerCase(entry->path().extension().string());
    if (withoutExtension(path) == stem && isFile(path) &&
      std::find(Others.begin(), Others.end(), extension) == Others.end())
    {
      found.push_back(path);
    }
  }
  return found;
}

// NAME.img for NAME.hdr or NAME.img.hdr; the first of the known names that exists, else all files of that name.
std::vector<std::string> dataFilesOf(const std::string& header)
{
  const std::string stem = withoutExtension(header);
  if (isFile(stem))
  {
    return { stem };
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
        return { candidate };
      }
    }
  }
  return filesNamed(stem);
}

std::string dataFileOf(const std::string& header)
{
  const auto found = dataFilesOf(header);
  if (found.size() == 1)
  {
    return found.front();
  }
  const std::string name = fs::path(header).stem().string();
  throw FormatError(header,
    found.empty() ? "has no data file beside it"
                  : "has several files beside it that may be its data",
    name + " or " + name + " with .img, .dat, .raw, .bil, .bsq, .bip, .bin or .cube",
    found.empty() ? "put the data file beside the header" : "open the data file instead");
}

// A picture, text or table that shares its name with an image must not be read as its samples: 'path' is data if the
// header is named after the whole of it, or it is named as data are, or the header itself would find it.
bool mayBeDataOf(const std::string& header, const std::string& path)
{
  if (withoutExtension(header) == path || hasDataExtension(path) || !fs::path(path).has_extension())
  {
    return true;
  }
  const auto found = dataFilesOf(header);
  return std::find(found.begin(), found.end(), path) != found.end();
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
      if (candidate != path && isFile(candidate) && isHeader(candidate) &&
        mayBeDataOf(candidate, path))
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

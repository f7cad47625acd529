#include "Formats/Storage/WholeFile.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/RandomAccessFile.h"
#include "Formats/Text/TextEncoding.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace msi
{

namespace
{
[[noreturn]] void throwUnreadable(const std::string& path, const std::string& reason)
{
  throw FormatError(path, "cannot be read (" + reason + ")", "a readable file",
    "check the name and the access rights");
}
}

void requireReadableFile(const std::string& path)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::directory)
  {
    throw FormatError(path, "is a folder", "a file", "name a file in it");
  }
  if (!std::filesystem::exists(status))
  {
    throwUnreadable(path, "No such file or directory");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw FormatError(path, "is no ordinary file", "a file", "copy its content into a file");
  }
  errno = 0;
  if (!std::ifstream(path, std::ios::binary))
  {
    throwUnreadable(path, std::strerror(errno));
  }
}

std::string readFileBeginning(const std::string& path, std::size_t count)
{
  const RandomAccessFile file(path);
  std::string bytes(std::min(static_cast<std::size_t>(file.size()), count), '\0');
  file.read(0, bytes.data(), bytes.size());
  return bytes;
}

std::string readWholeFile(const std::string& path)
{
  return readFileBeginning(path, std::string::npos);
}

std::string readTextFile(const std::string& path, const std::string& expected)
{
  const auto text = asUtf8(readWholeFile(path));
  if (!text)
  {
    throw FormatError(path, "is damaged UTF-16 text", expected + " in UTF-8", "save it as UTF-8");
  }
  if (text->find('\0') != std::string::npos)
  {
    throw FormatError(path, "is a binary file", expected, "name another file");
  }
  if (text->find_first_not_of(" \t\r\n") == std::string::npos)
  {
    throw FormatError(path, "is empty", expected, "check how it was written");
  }
  return *text;
}

} // namespace msi

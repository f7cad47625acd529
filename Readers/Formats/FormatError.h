// What every reader and writer of this room throws when a file cannot be read or written.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace msi
{

// Where in which file. Lines and columns count from 1; 0 means "not known" and is left out of the
// text. A column is a character position in its line, so that an editor can jump to it.
struct FilePlace
{
  std::string file;
  std::int64_t line = 0;
  std::int64_t column = 0;
};

// One clear line: "FILE:LINE:COLUMN: what; expected ...; to do".
//
// what() is the whole line. 'expected' and 'remedy' may be empty and are then left out.
class FormatError : public std::runtime_error
{
public:
  FormatError(const FilePlace& place, const std::string& what, const std::string& expected = {},
    const std::string& remedy = {});
  FormatError(const std::string& file, const std::string& what, const std::string& expected = {},
    const std::string& remedy = {});

  const FilePlace& place() const noexcept { return Place; }

private:
  FilePlace Place;
};

} // namespace msi

// Reads small files whole, with the errors that people run into.
#pragma once

#include <string>

namespace msi
{

// Throws FormatError unless path is a readable, ordinary file.
void requireReadableFile(const std::string& path);

// The bytes as they are.
std::string readWholeFile(const std::string& path);

// At most 'count' bytes from the beginning.
std::string readFileBeginning(const std::string& path, std::size_t count);

// The text as UTF-8 without a byte order mark (Text/TextEncoding.h). Refuses empty files, binary files and damaged
// UTF-16; 'expected' is what the message says was expected ("a sample table").
std::string readTextFile(const std::string& path, const std::string& expected);

} // namespace msi

// The grammar of an ENVI header: keys and values, with their places.
#pragma once

#include "Formats/FormatError.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

struct EnviValue
{
  std::string text;                    // without braces; line ends became blanks
  FilePlace place;                     // of the key
  std::optional<FilePlace> otherPlace; // of the key again, with another value
  bool used = false;
};

class EnviHeaderText
{
public:
  // Errors: FormatError for a first line other than ENVI and a brace without end. Lines that are no
  // "key = value" are noted.
  EnviHeaderText(const std::string& file, const std::string& text);

  // Each marks the key as used. Errors: FormatError naming line, key and value; also where the key stands twice
  // with different values.
  std::optional<std::string> find(const std::string& key);
  std::int64_t requireInteger(const std::string& key, std::int64_t least);
  std::optional<std::int64_t> findInteger(const std::string& key, std::int64_t least);
  std::optional<double> findNumber(const std::string& key);
  std::optional<std::vector<std::string>> findList(const std::string& key);
  // As many numbers as 'count'; 'each' says what each is for.
  std::optional<std::vector<double>> findNumbers(
    const std::string& key, std::int64_t count, const std::string& each = "one for each band");
  std::string require(const std::string& key);

  // An error at the place of a key that was found.
  [[noreturn]] void refuse(const std::string& key, const std::string& what,
    const std::string& expected, const std::string& remedy = "correct the header") const;

  std::map<std::string, std::string> unusedKeys() const;
  const std::vector<std::string>& notes() const noexcept { return Notes; }
  const std::string& file() const noexcept { return File; }

private:
  void takeLine(const std::string& text, std::size_t& at);
  void add(const std::string& key, EnviValue value);

  std::string File;
  std::map<std::string, EnviValue> Values; // by key in lower case with single blanks
  std::vector<std::string> Notes;
  std::int64_t Line = 1;
};

} // namespace msi

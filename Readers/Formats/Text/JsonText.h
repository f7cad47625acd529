// The values of a JSON text, with errors that name file, line and key.
#pragma once

#include "Formats/FormatError.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace msi
{

class JsonText
{
public:
  using Json = nlohmann::json;

  JsonText(std::string file, std::string text);

  // The whole text. Errors: FormatError at the line where the text is no JSON.
  Json parse() const;
  const std::string& file() const noexcept { return File; }
  // The place of the nth key of this name, counted from 0; the file where it is not found.
  FilePlace placeOfKey(const std::string& key, std::size_t nth = 0) const;

  // The value of a key; null where it is missing or null.
  static const Json* find(const Json& object, const char* key);

  // These refuse a value of another kind, naming the key and what was expected.
  std::optional<std::string> text(const Json& object, const char* key) const;
  std::optional<double> number(const Json& object, const char* key) const;
  std::optional<double> numberFromZero(const Json& object, const char* key) const;
  // Of noise, relative to white; counts are larger.
  std::optional<double> deviation(const Json& object, const char* key) const;
  std::optional<bool> truth(const Json& object, const char* key) const;
  // One number, or one per channel; empty where the key is missing or null.
  std::vector<double> channelNumbers(const Json& object, const char* key) const;

  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;
  void requireType(bool fits, const std::string& key, const std::string& expected) const;

private:
  std::string File;
  std::string Text;
};

} // namespace msi

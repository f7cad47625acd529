// A table of text whose cells know where they stood: what every table format is turned into.
#pragma once

#include "Formats/FormatError.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

struct TextCell
{
  std::string_view text; // into TextTable::storage
  std::int32_t line = 0;
  std::int32_t column = 0;
};

using TextRow = std::vector<TextCell>;

struct TextTable
{
  std::string file;
  std::vector<TextRow> rows;   // never empty; the header, where there is one, is the first
  bool decimalComma = false;   // numbers may have a decimal comma
  bool endsInsideLine = false; // the last line has no line end: perhaps the file was cut off
  std::shared_ptr<const std::string> storage;

  FilePlace place(const TextCell& cell) const { return { file, cell.line, cell.column }; }
};

} // namespace msi

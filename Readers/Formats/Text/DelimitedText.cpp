#include "Formats/Text/DelimitedText.h"

#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <csv.h>

namespace msi
{

namespace
{
constexpr char Blank = ' ';

std::size_t lineEnd(const std::string& text, std::size_t begin)
{
  return std::min(text.find_first_of("\r\n", begin), text.size());
}

// What spreadsheet programs write in the first line: "sep=;".
bool statesDelimiter(const std::string& text)
{
  constexpr std::string_view key = "sep=";
  return lowerCase(std::string_view(text).substr(0, key.size())) == key &&
    lineEnd(text, 0) == key.size() + 1;
}

bool isComment(const std::string& text, std::size_t lineBegin)
{
  if (lineBegin == 0 && statesDelimiter(text))
  {
    return true;
  }
  const std::size_t first = text.find_first_not_of(" \t", lineBegin);
  return first != std::string::npos && text[first] == '#';
}

// The first line that is neither blank nor a comment.
std::string_view firstLine(const std::string& text)
{
  std::size_t begin = 0;
  while (begin < text.size())
  {
    const std::size_t end = lineEnd(text, begin);
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    if (!trimmed(line).empty() && !isComment(text, begin))
    {
      return line;
    }
    begin = end + 1;
  }
  return {};
}

char delimiterOf(std::string_view line)
{
  std::array<std::size_t, 256> count{};
  bool quoted = false;
  for (const char c : line)
  {
    quoted = quoted != (c == '"');
    if (!quoted)
    {
      ++count[static_cast<unsigned char>(c)];
    }
  }
  if (count['\t'] > 0)
  {
    return '\t';
  }
  // With a decimal comma no field holds more than one comma.
  if (count[';'] > 0 && count[','] <= count[';'] + 1)
  {
    return ';';
  }
  if (count[','] > 0)
  {
    return ',';
  }
  return trimmed(line).find(Blank) != std::string_view::npos ? Blank : ',';
}

class Splitter
{
public:
  Splitter(TextTable& table, std::string& storage)
    : Table(table)
    , Storage(storage)
  {
  }

  void feed(const std::string& text, char delimiter)
  {
    csv_parser parser;
    csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI);
    csv_set_delim(&parser, static_cast<unsigned char>(delimiter));
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
      const char c = text[i];
      if (Current.empty() && AtLineBegin && isComment(text, i))
      {
        i = lineEnd(text, i);
        i += i + 1 < text.size() && text[i] == '\r' && text[i + 1] == '\n' ? 1 : 0;
        nextLine();
        continue;
      }
      if (AtFieldBegin && c != Blank)
      {
        FieldLine = Line;
        FieldColumn = Column;
        AtFieldBegin = false;
      }
      quoted = quoted != (c == '"');
      if (csv_parse(&parser, &c, 1, &Splitter::onField, &Splitter::onRow, this) != 1)
      {
        csv_free(&parser);
        throw FormatError(FilePlace{ Table.file, Line, Column }, "a quote stands inside a field",
          "quotes around whole fields, inner quotes doubled", "correct this line");
      }
      AtFieldBegin = AtFieldBegin || (!quoted && c == delimiter);
      if (c == '\n' || (c == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')))
      {
        nextLine();
        AtLineBegin = !quoted;
        AtFieldBegin = AtFieldBegin || !quoted;
      }
      else
      {
        ++Column;
        AtLineBegin = false;
      }
    }
    const int finished = csv_fini(&parser, &Splitter::onField, &Splitter::onRow, this);
    csv_free(&parser);
    if (finished != 0)
    {
      throw FormatError(FilePlace{ Table.file, FieldLine, FieldColumn },
        "a quoted field has no end", "a closing quote",
        "the file seems to be cut off, or this quote is one too many");
    }
  }

private:
  static void onField(void* bytes, std::size_t count, void* self)
  {
    auto& splitter = *static_cast<Splitter*>(self);
    std::string& storage = splitter.Storage;
    const std::size_t begin = storage.size();
    storage.append(static_cast<const char*>(bytes), count); // stays within its reserved capacity
    splitter.Current.push_back({ trimmed(std::string_view(storage).substr(begin)),
      static_cast<std::int32_t>(splitter.FieldLine),
      static_cast<std::int32_t>(splitter.FieldColumn) });
    splitter.FieldLine = splitter.Line;
    splitter.FieldColumn = splitter.Column;
  }

  static void onRow(int, void* self)
  {
    auto& splitter = *static_cast<Splitter*>(self);
    if (std::any_of(splitter.Current.begin(), splitter.Current.end(),
          [](const TextCell& cell) { return !cell.text.empty(); }))
    {
      splitter.Table.rows.push_back(splitter.Current);
    }
    splitter.Current.clear();
  }

  void nextLine()
  {
    ++Line;
    Column = 1;
    AtLineBegin = true;
  }

  TextTable& Table;
  std::string& Storage;
  TextRow Current;
  std::int64_t Line = 1;
  std::int64_t Column = 1;
  std::int64_t FieldLine = 1;
  std::int64_t FieldColumn = 1;
  bool AtLineBegin = true;
  bool AtFieldBegin = true;
};

void splitAtBlanks(TextTable& table, const std::string& text)
{
  std::int32_t line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line)
  {
    const std::size_t end = lineEnd(text, begin);
    TextRow row;
    std::size_t at = isComment(text, begin) ? end : begin;
    while ((at = text.find_first_not_of(" \t", at)) < end)
    {
      const std::size_t stop = std::min(text.find_first_of(" \t\r\n", at), text.size());
      row.push_back({ std::string_view(text).substr(at, stop - at), line,
        static_cast<std::int32_t>(at - begin + 1) });
      at = stop;
    }
    if (!row.empty())
    {
      table.rows.push_back(std::move(row));
    }
    const bool pair = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
    begin = end + (pair ? 2 : 1);
  }
}

void dropEmptyColumnsAtTheRight(TextTable& table)
{
  std::size_t used = 0;
  for (const TextRow& row : table.rows)
  {
    const auto last = std::find_if(
      row.rbegin(), row.rend(), [](const TextCell& cell) { return !cell.text.empty(); });
    used = std::max(used, static_cast<std::size_t>(row.rend() - last));
  }
  for (TextRow& row : table.rows)
  {
    row.resize(std::min(row.size(), used));
  }
}
}

TextTable parseDelimitedText(const std::string& file, const std::string& text)
{
  TextTable table;
  table.file = file;
  constexpr std::size_t PlaceOfDelimiter = 4;
  const char delimiter =
    statesDelimiter(text) ? text[PlaceOfDelimiter] : delimiterOf(firstLine(text));
  table.decimalComma = delimiter != ',';
  table.endsInsideLine = !text.empty() && text.back() != '\n' && text.back() != '\r';
  auto storage = std::make_shared<std::string>();
  if (delimiter == Blank)
  {
    *storage = text;
    splitAtBlanks(table, *storage);
  }
  else
  {
    storage->reserve(text.size());
    Splitter(table, *storage).feed(text, delimiter);
    dropEmptyColumnsAtTheRight(table);
  }
  table.storage = std::move(storage);
  if (table.rows.empty())
  {
    throw FormatError(
      file, "holds no table, only comments", "a header line and rows", "name another file");
  }
  return table;
}

} // namespace msi

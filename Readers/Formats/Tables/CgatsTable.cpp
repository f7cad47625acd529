#include "Formats/Tables/CgatsTable.h"

#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace msi
{

namespace
{
// Words and quoted strings; # begins a comment that ends with the line.
class Tokens
{
public:
  explicit Tokens(std::string_view text)
    : Text(text)
  {
  }

  // Text of size 0 with line 0 at the end.
  TextCell next()
  {
    skipBlanksAndComments();
    if (At == Text.size())
    {
      return {};
    }
    const auto line = Line;
    const auto column = static_cast<std::int32_t>(At - LineBegin + 1);
    std::size_t begin = At;
    std::size_t end;
    const char quote = Text[At];
    if (quote == '"' || quote == '\'')
    {
      begin = At + 1;
      end = std::min(Text.find_first_of(std::string("\r\n") + quote, begin), Text.size());
      At = end < Text.size() && Text[end] == quote ? end + 1 : end;
    }
    else
    {
      end = std::min(Text.find_first_of(" \t\r\n", begin), Text.size());
      At = end;
    }
    return { Text.substr(begin, end - begin), line, column };
  }

private:
  void skipBlanksAndComments()
  {
    for (; At < Text.size(); ++At)
    {
      if (Text[At] == '#')
      {
        At = std::min(Text.find_first_of("\r\n", At), Text.size());
        if (At == Text.size())
        {
          return;
        }
      }
      if (Text[At] == '\n' || (Text[At] == '\r' && Text.substr(At, 2) != "\r\n"))
      {
        ++Line;
        LineBegin = At + 1;
      }
      else if (std::string_view(" \t\r\v\f").find(Text[At]) == std::string_view::npos)
      {
        return;
      }
    }
  }

  std::string_view Text;
  std::size_t At = 0;
  std::size_t LineBegin = 0;
  std::int32_t Line = 1;
};

struct Section
{
  TextRow fields;
  std::vector<TextRow> rows;
  std::optional<TextCell> declaredFields;
  std::optional<TextCell> declaredSets;
  TextCell formatPlace;
};

class CgatsParser
{
public:
  CgatsParser(const std::string& file, std::string_view text)
    : File(file)
    , In(text)
  {
  }

  std::vector<Section> parse()
  {
    Section section;
    for (TextCell token = In.next(); token.line > 0; token = In.next())
    {
      if (token.text == "NUMBER_OF_FIELDS")
      {
        section.declaredFields = In.next();
      }
      else if (token.text == "NUMBER_OF_SETS")
      {
        section.declaredSets = In.next();
      }
      else if (token.text == "BEGIN_DATA_FORMAT")
      {
        section.formatPlace = token;
        section.fields = until("END_DATA_FORMAT", token);
        requireCount(section.declaredFields, section.fields.size(), "NUMBER_OF_FIELDS");
      }
      else if (token.text == "BEGIN_DATA")
      {
        takeData(section, token);
        Sections.push_back(std::move(section));
        // Argyll files repeat the format only where it differs; the standard lets it stand.
        section = Section();
        section.fields = Sections.back().fields;
      }
    }
    if (Sections.empty())
    {
      throw FormatError(File, "has no BEGIN_DATA", "a CGATS file with a data section",
        "the file seems to be cut off");
    }
    return std::move(Sections);
  }

private:
  FilePlace place(const TextCell& cell) const { return { File, cell.line, cell.column }; }

  TextRow until(std::string_view end, const TextCell& begin)
  {
    TextRow tokens;
    for (TextCell token = In.next(); token.text != end; token = In.next())
    {
      if (token.line == 0)
      {
        throw FormatError(place(begin), std::string(begin.text) + " has no end", std::string(end),
          "the file seems to be cut off");
      }
      tokens.push_back(token);
    }
    return tokens;
  }

  void requireCount(const std::optional<TextCell>& declared, std::size_t found, const char* key)
  {
    if (!declared)
    {
      return;
    }
    const auto count = parseInteger(declared->text);
    if (!count || *count < 0 || static_cast<std::size_t>(*count) != found)
    {
      throw FormatError(place(*declared), std::string(key) + " is " + std::string(declared->text),
        std::to_string(found) + ", the number found", "correct the number or complete the file");
    }
  }

  void takeData(Section& section, const TextCell& begin)
  {
    if (section.fields.empty())
    {
      throw FormatError(place(begin), "BEGIN_DATA comes without field names",
        "BEGIN_DATA_FORMAT with field names before it", "check how the file was written");
    }
    const TextRow values = until("END_DATA", begin);
    const std::size_t width = section.fields.size();
    if (values.size() % width != 0)
    {
      throw FormatError(place(oddRowOf(values, width)),
        "the data are " + std::to_string(values.size()) + " values, and " + std::to_string(width) +
          " fields are named",
        std::to_string(width) + " values in each set", "complete the set that is short");
    }
    for (std::size_t i = 0; i < values.size(); i += width)
    {
      section.rows.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(i),
        values.begin() + static_cast<std::ptrdiff_t>(i + width));
    }
    requireCount(section.declaredSets, section.rows.size(), "NUMBER_OF_SETS");
  }

  // The first line that holds another number of values than there are fields, where sets are lines.
  static TextCell oddRowOf(const TextRow& values, std::size_t width)
  {
    for (std::size_t i = 0; i < values.size();)
    {
      std::size_t end = i;
      while (end < values.size() && values[end].line == values[i].line)
      {
        ++end;
      }
      if (end - i != width)
      {
        return values[i];
      }
      i = end;
    }
    return values.back();
  }

  const std::string& File;
  Tokens In;
  std::vector<Section> Sections;
};

bool hasSpectralOrResponse(const Section& section)
{
  return std::any_of(section.fields.begin(), section.fields.end(),
    [](const TextCell& field)
    { return reflectanceColumnWavelength(field.text) || responseColumnNumber(field.text); });
}

void nameTheSamples(TextRow& header)
{
  for (const std::string_view key : { "SAMPLE_NAME", "SAMPLE_ID", "SAMPLE_LOC" })
  {
    const auto field = std::find_if(
      header.begin(), header.end(), [key](const TextCell& cell) { return cell.text == key; });
    if (field != header.end())
    {
      field->text = "sample";
      return;
    }
  }
}
}

bool looksLikeCgats(std::string_view text) noexcept
{
  static constexpr std::array<std::string_view, 5> Opening = { "CGATS", "CTI", "IT8", "ISO28178",
    "LGOROWLENGTH" };
  const std::string_view first = trimmed(text.substr(0, text.find_first_of("\r\n")));
  return std::any_of(Opening.begin(), Opening.end(),
           [first](std::string_view key) { return first.substr(0, key.size()) == key; }) ||
    text.find("BEGIN_DATA_FORMAT") != std::string_view::npos;
}

TextTable parseCgats(const std::string& file, const std::string& text)
{
  TextTable table;
  table.file = file;
  table.decimalComma = true; // against the standard, but nothing else in it is written with a comma
  auto storage = std::make_shared<const std::string>(text);
  auto sections = CgatsParser(file, *storage).parse();
  auto chosen = std::find_if(sections.begin(), sections.end(), hasSpectralOrResponse);
  chosen = chosen == sections.end() ? sections.begin() : chosen;
  table.rows.push_back(std::move(chosen->fields));
  nameTheSamples(table.rows[0]);
  std::move(chosen->rows.begin(), chosen->rows.end(), std::back_inserter(table.rows));
  table.storage = std::move(storage);
  return table;
}

} // namespace msi

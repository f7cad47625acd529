#include "Formats/Text/CsvText.h"

#include "Formats/Text/NumberText.h"

#include <cstddef>

#include <csv.h>

namespace msi
{

std::string csvField(const std::string& text)
{
  const bool blankEnds = !text.empty() && (text.front() == ' ' || text.back() == ' ');
  if (text.find_first_of(",;\t\"\r\n#") == std::string::npos && !blankEnds)
  {
    return text;
  }
  std::string field(csv_write(nullptr, 0, text.data(), text.size()), '\0');
  csv_write(field.data(), field.size(), text.data(), text.size());
  return field;
}

namespace
{
// Behind any number of apostrophes, so that the way back is always the same.
bool looksLikeFormula(std::string_view text)
{
  const std::size_t first = text.find_first_not_of('\'');
  return first != std::string_view::npos &&
    std::string_view("=+-@\t\r").find(text[first]) != std::string_view::npos && !parseNumber(text);
}
}

std::string withoutFormula(const std::string& text)
{
  return looksLikeFormula(text) ? '\'' + text : text;
}

std::string_view withFormula(std::string_view text)
{
  return text.substr(0, 1) == "'" && looksLikeFormula(text.substr(1)) ? text.substr(1) : text;
}

} // namespace msi

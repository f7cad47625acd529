#include "Formats/Text/CsvText.h"

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

} // namespace msi

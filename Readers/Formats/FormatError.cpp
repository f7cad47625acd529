#include "Formats/FormatError.h"

#include "Formats/Text/PrintableText.h"

namespace msi
{

namespace
{
std::string compose(const FilePlace& place, const std::string& what, const std::string& expected,
  const std::string& remedy)
{
  std::string text = place.file;
  if (place.line > 0)
  {
    text += ':' + std::to_string(place.line);
    if (place.column > 0)
    {
      text += ':' + std::to_string(place.column);
    }
  }
  text += ": " + what;
  if (!expected.empty())
  {
    text += "; expected " + expected;
  }
  if (!remedy.empty())
  {
    text += "; " + remedy;
  }
  return printable(text);
}
}

FormatError::FormatError(const FilePlace& place, const std::string& what,
  const std::string& expected, const std::string& remedy)
  : std::runtime_error(compose(place, what, expected, remedy))
  , Place(place)
{
}

FormatError::FormatError(const std::string& file, const std::string& what,
  const std::string& expected, const std::string& remedy)
  : FormatError(FilePlace{ file, 0, 0 }, what, expected, remedy)
{
}

} // namespace msi

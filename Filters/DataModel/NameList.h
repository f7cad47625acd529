// Lists of names in a property, and the names of errors.
#ifndef NameList_h
#define NameList_h

#include <string>
#include <vector>

namespace msi
{

// The names in a list that commas or spaces separate.
std::vector<std::string> namesIn(const std::string& list);

// What an error is called: metric "rms" or "dE00", and the illuminant of the latter.
struct ErrorName
{
  std::string metric;
  std::string illuminant;

  std::string text() const { return illuminant.empty() ? metric : metric + " " + illuminant; }
};

// "rms", then "dE00" under each illuminant.
std::vector<ErrorName> errorNames(const std::vector<std::string>& illuminants);

} // namespace msi

#endif

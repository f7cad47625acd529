// Lists of names in a property, and the names of errors.
#ifndef NameList_h
#define NameList_h

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// The names in a list that line ends separate, or commas and spaces where it has no line end.
std::vector<std::string> namesIn(const std::string& list);

// The list with more names, which commas separate and which may hold spaces.
std::string withNames(const std::string& list, const std::string& more);

// 'a', 'b', 'c'
std::string quotedNames(const std::vector<std::string>& names);

// What an error is called: a metric of spectra ("rms", "gfc") or of colors ("dE00"), with the illuminant of the latter.
struct ErrorName
{
  std::string metric;
  std::string illuminant;

  std::string text() const { return illuminant.empty() ? metric : metric + " " + illuminant; }
};

// The metric of the special metamerism index; its illuminant is the one that light changes to.
inline constexpr const char* MetamerismMetric = "metamerism";

// "rms", then each metric of colors under each illuminant.
std::vector<ErrorName> errorNames(
  const std::vector<std::string>& illuminants, const std::vector<std::string>& colorMetrics);

// The name of an error from its text; nothing where it begins with no known metric.
std::optional<ErrorName> errorNameIn(const std::string& text);

} // namespace msi

#endif

#include "NameList.h"

#include "Kernels/Difference/ColorDifference.h"
#include "Kernels/Difference/SpectralMetric.h"

#include <algorithm>
#include <sstream>

namespace msi
{

namespace
{
// What stands between the separators, without blanks around it.
std::vector<std::string> partsOf(const std::string& list, char separator)
{
  constexpr const char* Blanks = " \t\r\n";
  std::vector<std::string> parts;
  std::istringstream text(list);
  for (std::string part; std::getline(text, part, separator);)
  {
    const auto begin = part.find_first_not_of(Blanks);
    if (begin != std::string::npos)
    {
      parts.push_back(part.substr(begin, part.find_last_not_of(Blanks) + 1 - begin));
    }
  }
  return parts;
}
}

std::vector<std::string> namesIn(const std::string& list)
{
  if (list.find('\n') != std::string::npos)
  {
    return partsOf(list, '\n');
  }
  std::string plain = list;
  std::replace(plain.begin(), plain.end(), ',', ' ');
  return partsOf(plain, ' ');
}

std::string withNames(const std::string& list, const std::string& more)
{
  std::string result;
  for (const auto& names : { namesIn(list), partsOf(more, ',') })
  {
    for (const auto& name : names)
    {
      result += name + '\n';
    }
  }
  return result;
}

std::string quotedNames(const std::vector<std::string>& names)
{
  std::string text;
  for (const auto& name : names)
  {
    text += (text.empty() ? "'" : ", '") + name + "'";
  }
  return text;
}

std::vector<ErrorName> errorNames(
  const std::vector<std::string>& illuminants, const std::vector<std::string>& colorMetrics)
{
  std::vector<ErrorName> names{ { "rms", "" } };
  for (const auto& metric : colorMetrics)
  {
    for (const auto& illuminant : illuminants)
    {
      names.push_back({ metric, illuminant });
    }
  }
  return names;
}

std::optional<ErrorName> errorNameIn(const std::string& text)
{
  const auto blank = text.find(' ');
  const std::string metric = text.substr(0, blank);
  if (blank == std::string::npos)
  {
    return metric == "rms" || findSpectralMetric(metric) ? std::optional(ErrorName{ metric, "" })
                                                         : std::nullopt;
  }
  const auto& formulas = colorDifferences();
  const std::string plain = metric.substr(0, metric.find('('));
  const bool known = plain == MetamerismMetric ||
    std::any_of(formulas.begin(), formulas.end(),
      [&plain](const auto& formula) { return formula.metric == plain; });
  return known && blank + 1 < text.size()
    ? std::optional(ErrorName{ metric, text.substr(blank + 1) })
    : std::nullopt;
}

} // namespace msi

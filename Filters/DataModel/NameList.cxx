#include "NameList.h"

#include "Kernels/Difference/ColorDifference.h"
#include "Kernels/Difference/SpectralMetric.h"

#include <algorithm>
#include <sstream>

namespace msi
{

std::vector<std::string> namesIn(const std::string& list)
{
  std::string plain = list;
  std::replace(plain.begin(), plain.end(), ',', ' ');
  std::istringstream words(plain);
  std::vector<std::string> names;
  for (std::string name; words >> name;)
  {
    names.push_back(name);
  }
  return names;
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

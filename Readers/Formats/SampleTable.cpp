#include "Formats/SampleTable.h"

#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace msi
{

std::vector<double> MetadataColumn::numbers() const
{
  std::vector<double> values;
  values.reserve(text.size());
  bool any = false;
  for (const std::string& cell : text)
  {
    const auto value = parseNumber(cell);
    if (!value && !cell.empty())
    {
      return {};
    }
    any = any || value.has_value();
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return any ? values : std::vector<double>{};
}

Eigen::Index SampleTable::sampleCount() const noexcept
{
  if (hasReflectance())
  {
    return reflectance.cols();
  }
  if (hasResponses())
  {
    return responses.cols();
  }
  return metadata.empty() ? 0 : static_cast<Eigen::Index>(metadata.front().text.size());
}

const MetadataColumn* SampleTable::findMetadata(const std::string& name) const
{
  const std::string wanted = lowerCase(name);
  const auto found = std::find_if(metadata.begin(), metadata.end(),
    [&wanted](const MetadataColumn& column) { return lowerCase(column.name) == wanted; });
  return found == metadata.end() ? nullptr : &*found;
}

std::vector<std::string> SampleTable::sampleNames() const
{
  if (const MetadataColumn* column = findMetadata("sample"))
  {
    return column->text;
  }
  std::vector<std::string> names;
  for (Eigen::Index i = 1; i <= sampleCount(); ++i)
  {
    names.push_back(std::to_string(i));
  }
  return names;
}

} // namespace msi

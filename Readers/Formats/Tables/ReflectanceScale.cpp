#include "Formats/Tables/ReflectanceScale.h"

#include "Formats/Text/NumberText.h"

#include <string>

namespace msi
{

namespace
{
constexpr double LargestFactor = 2.0;
constexpr double PercentPerFactor = 100.0;
const char* const Remedy = "bring all samples to one unit, or state the unit in the options";

std::string nameOf(const SampleTable& table, Eigen::Index sample)
{
  return "sample '" + table.sampleNames()[static_cast<std::size_t>(sample)] + "'";
}
}

void bringToFactor(SampleTable& table, ReflectanceUnit unit,
  const std::function<FilePlace(Eigen::Index sample)>& placeOf)
{
  if (unit == ReflectanceUnit::Factor || table.reflectance.size() == 0)
  {
    return;
  }
  const Eigen::RowVectorXd largest = table.reflectance.colwise().maxCoeff();
  const Eigen::Index samples = largest.size();
  const Eigen::Index above = (largest.array() > LargestFactor).count();
  if (unit == ReflectanceUnit::Recognize)
  {
    if (above == 0)
    {
      return;
    }
    const bool percent = 2 * above > samples;
    if (!percent || 4 * (samples - above) > samples)
    {
      Eigen::Index odd = 0;
      while ((largest[odd] > LargestFactor) == percent)
      {
        ++odd;
      }
      throw FormatError(placeOf(odd),
        nameOf(table, odd) + " has a largest reflectance of " + numberText(largest[odd]) +
          ", while " + std::to_string(percent ? above : samples - above) + " of " +
          std::to_string(samples) + " samples look like " + (percent ? "percent" : "factors"),
        "either percent or factors in the whole file", Remedy);
    }
  }
  table.reflectance /= PercentPerFactor;
  std::string note = "reflectance was in percent: divided by 100";
  if (above < samples && unit == ReflectanceUnit::Recognize)
  {
    Eigen::Index dark = 0;
    largest.minCoeff(&dark);
    note += " (" + std::to_string(samples - above) + " of " + std::to_string(samples) +
      " samples stay below 2 percent; the darkest is " + nameOf(table, dark) + ")";
  }
  table.notes.push_back(std::move(note));
}

} // namespace msi

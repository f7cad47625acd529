#include "Formats/Tables/ReflectanceScale.h"

#include "Formats/Text/NumberText.h"

#include "Kernels/Spectra/Counted.h"
#include "Kernels/Spectra/PossibleValues.h"

#include <optional>
#include <string>

namespace msi
{

namespace
{
using PlaceOf = std::function<FilePlace(Eigen::Index sample)>;

constexpr double LargestFactor = 2.0;
constexpr double PercentPerFactor = 100.0;
constexpr double LeastNoise = -0.01; // of white
const char* const Remedy = "bring all samples to one unit, or state the unit in the options";

std::string nameOf(const SampleTable& table, Eigen::Index sample)
{
  return "sample '" + table.sampleNames()[static_cast<std::size_t>(sample)] + "'";
}

void scaleToFactor(SampleTable& table, ReflectanceUnit unit, const PlaceOf& placeOf)
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

[[noreturn]] void refuse(const SampleTable& table, const PlaceOf& placeOf,
  const ImpossibleValue& found, const std::string& what)
{
  throw FormatError(placeOf(found.column),
    nameOf(table, found.column) + " has a " + what + " of " + numberText(found.value),
    found.expected, "remove the sample if this marks a missing value");
}

void requirePossible(const SampleTable& table, const PlaceOf& placeOf)
{
  if (const auto found = findImpossibleReflectance(table.reflectance))
  {
    refuse(table, placeOf, *found,
      "reflectance factor at " + numberText((*table.wavelengths)[found->row]) + " nm");
  }
  if (const auto found = findImpossibleResponse(table.responses))
  {
    refuse(table, placeOf, *found,
      "response in channel " + table.channelNames[static_cast<std::size_t>(found->row)]);
  }
}

void noteNegativeReflectance(SampleTable& table)
{
  const Eigen::Index negative = (table.reflectance.array() < LeastNoise).colwise().any().count();
  if (negative > 0)
  {
    Eigen::Index band = 0;
    Eigen::Index sample = 0;
    const double least = table.reflectance.minCoeff(&band, &sample);
    table.notes.push_back("reflectance is below 0 in " + counted(negative, "sample") +
      ", down to " + numberText(least) + " in " + nameOf(table, sample) + " at " +
      numberText((*table.wavelengths)[band]) + " nm");
  }
}
}

void bringToFactor(SampleTable& table, ReflectanceUnit unit, const PlaceOf& placeOf)
{
  scaleToFactor(table, unit, placeOf);
  requirePossible(table, placeOf);
  noteNegativeReflectance(table);
}

} // namespace msi

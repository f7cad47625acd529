#include "Formats/Arrays/ArrayWavelengths.h"

#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace msi
{

namespace
{
constexpr double ShortestNanometres = 100.0;
constexpr double LongestNanometres = 20000.0;
constexpr double NanometresPerMicrometre = 1000.0;
constexpr std::int64_t MostWavelengths = 1 << 20;

bool isVector(const NamedArray& array)
{
  return !array.isText && array.count() > 1 && array.count() <= MostWavelengths &&
    *std::max_element(array.shape.begin(), array.shape.end()) == array.count();
}

bool isWavelengthName(const std::string& path)
{
  static constexpr std::array<std::string_view, 11> Whole = { "wl", "nm", "lambda", "lambdas",
    "lam", "wave", "waves", "wvl", "wvls", "bands", "centers" };
  const std::string name = lowerCase(path.substr(path.find_last_of("/.") + 1));
  return name.find("wavelength") != std::string::npos ||
    name.find("wavelen") != std::string::npos ||
    std::find(Whole.begin(), Whole.end(), name) != Whole.end();
}

// As nm; empty where the numbers are no wavelengths. Whole numbers below 100 count bands.
std::vector<double> wavelengthsOf(std::vector<double> values)
{
  const bool counts = std::all_of(
    values.begin(), values.end(), [](double value) { return value == std::floor(value); });
  if (!counts && *std::max_element(values.begin(), values.end()) < ShortestNanometres)
  {
    std::transform(values.begin(), values.end(), values.begin(),
      [](double um) { return withoutConversionNoise(um * NanometresPerMicrometre); });
  }
  const bool known = std::all_of(values.begin(), values.end(),
    [](double nm) { return nm >= ShortestNanometres && nm <= LongestNanometres; });
  return known ? values : std::vector<double>();
}
}

std::vector<double> findWavelengths(const ArrayFile& file, std::string& name)
{
  std::vector<double> found;
  bool several = false;
  const auto take = [&](const std::string& from, const std::vector<double>& values)
  {
    auto nm = wavelengthsOf(values);
    if (!nm.empty())
    {
      several = several || (!found.empty() && found != nm);
      found = std::move(nm);
      name = from;
    }
  };
  for (std::size_t i = 0; i < file.arrays().size(); ++i)
  {
    const NamedArray& array = file.arrays()[i];
    if (isVector(array) && isWavelengthName(array.name))
    {
      take(array.name, file.readAll(i));
    }
  }
  for (const auto& [attribute, values] : file.attributes())
  {
    if (found.empty() && isWavelengthName(attribute))
    {
      take(attribute, values);
    }
  }
  return several ? std::vector<double>() : found;
}

} // namespace msi

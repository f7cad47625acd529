#include "Formats/Arrays/ArrayWavelengths.h"

#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

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
  static constexpr std::array<std::string_view, 4> Whole = { "wl", "nm", "lambda", "lambdas" };
  const std::string name = lowerCase(path.substr(path.find_last_of('/') + 1));
  return name.find("wavelength") != std::string::npos ||
    name.find("wavelen") != std::string::npos ||
    std::find(Whole.begin(), Whole.end(), name) != Whole.end();
}

bool areWavelengths(const std::vector<double>& values)
{
  return std::all_of(values.begin(), values.end(),
    [](double nm) { return nm >= ShortestNanometres && nm <= LongestNanometres; });
}
}

std::vector<double> findWavelengths(const ArrayFile& file, std::string& name)
{
  std::vector<double> found;
  for (std::size_t i = 0; i < file.arrays().size(); ++i)
  {
    const NamedArray& array = file.arrays()[i];
    if (!isVector(array) || !isWavelengthName(array.name))
    {
      continue;
    }
    std::vector<double> values = file.readAll(i);
    if (*std::max_element(values.begin(), values.end()) < ShortestNanometres)
    {
      std::transform(values.begin(), values.end(), values.begin(),
        [](double um) { return withoutConversionNoise(um * NanometresPerMicrometre); });
    }
    if (!areWavelengths(values))
    {
      continue;
    }
    if (!found.empty() && found != values)
    {
      return {};
    }
    found = std::move(values);
    name = array.name;
  }
  return found;
}

} // namespace msi

#include "Formats/Images/BandOrder.h"

#include "Formats/FormatError.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace msi
{

namespace
{
constexpr double ShortestWavelength = 100.0; // as in msi::WavelengthGrid
constexpr double LongestWavelength = 20000.0;

template <typename T>
void permute(std::vector<T>& values, const std::vector<int>& order)
{
  if (values.empty())
  {
    return;
  }
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const int from : order)
  {
    sorted.push_back(values[static_cast<std::size_t>(from)]);
  }
  values = std::move(sorted);
}
}

void takeGivenWavelengths(
  SpectralImageInfo& info, const std::vector<double>& wavelengths, const std::string& file)
{
  if (wavelengths.empty())
  {
    return;
  }
  if (static_cast<int>(wavelengths.size()) != info.bands())
  {
    throw FormatError(file, std::to_string(wavelengths.size()) + " wavelengths were given",
      std::to_string(info.bands()) + ", one for each band", "complete the list");
  }
  requireGrid(wavelengths, file);
  info.wavelengths = wavelengths;
}

void requireGrid(const std::vector<double>& wavelengths, const std::string& file)
{
  auto sorted = wavelengths;
  std::sort(sorted.begin(), sorted.end());
  const std::string fault = faultOfGrid(sorted);
  if (!fault.empty())
  {
    throw FormatError(file, "of the wavelengths given " + fault,
      "different wavelengths from 100 to 20000 nm", "correct the list");
  }
}

std::string faultOfGrid(const std::vector<double>& sorted)
{
  const auto outside = std::find_if(sorted.begin(), sorted.end(),
    [](double nm) { return !(nm >= ShortestWavelength && nm <= LongestWavelength); });
  if (outside != sorted.end())
  {
    return "one is " + numberText(*outside) + " nm";
  }
  const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
  return twin == sorted.end() ? std::string() : "two are " + numberText(*twin) + " nm";
}

std::vector<int> sortByWavelength(SpectralImageInfo& info)
{
  std::vector<int> order(static_cast<std::size_t>(info.bands()));
  std::iota(order.begin(), order.end(), 0);
  if (info.wavelengths.empty())
  {
    return order;
  }
  const auto nm = [&info](int band) { return info.wavelengths[static_cast<std::size_t>(band)]; };
  if (!std::is_sorted(info.wavelengths.begin(), info.wavelengths.end()))
  {
    std::stable_sort(order.begin(), order.end(), [&nm](int a, int b) { return nm(a) < nm(b); });
    permute(info.bandNames, order);
    permute(info.fwhm, order);
    permute(info.goodBands, order);
    for (int& shown : info.displayBands)
    {
      shown = static_cast<int>(std::find(order.begin(), order.end(), shown) - order.begin());
    }
    permute(info.wavelengths, order);
    info.notes.emplace_back("bands were sorted by wavelength");
  }
  const std::string fault = faultOfGrid(info.wavelengths);
  if (!fault.empty())
  {
    info.notes.push_back("the wavelengths are unknown: " + fault);
    info.wavelengths.clear();
    info.fwhm.clear();
  }
  return order;
}

} // namespace msi

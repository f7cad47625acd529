#include "Kernels/Spectra/WavelengthGrid.h"

#include "Kernels/Spectra/Reject.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr double ShortestWavelength = 100.0;
constexpr double LongestWavelength = 20000.0;
constexpr double StepTolerance = 1e-6;
}

WavelengthGrid::WavelengthGrid(std::vector<double> nanometres)
  : Nanometres(std::move(nanometres))
{
  if (Nanometres.empty())
  {
    throw std::invalid_argument("a wavelength grid needs at least one wavelength");
  }
  for (std::size_t i = 0; i < Nanometres.size(); ++i)
  {
    const double value = Nanometres[i];
    if (!(value >= ShortestWavelength && value <= LongestWavelength))
    {
      reject("wavelength ", i + 1, " is ", value, " nm; expected a value from 100 to 20000 nm");
    }
    if (i > 0 && !(value > Nanometres[i - 1]))
    {
      reject("wavelength ", i + 1, " is ", value,
        " nm; expected wavelengths in strictly increasing order");
    }
  }
  Step = commonStep();
}

WavelengthGrid WavelengthGrid::uniform(double first, double last, double step)
{
  const double count = (last - first) / step;
  const double whole = std::round(count);
  if (!(step > 0.0) || !(whole >= 0.0) || !(whole < 1e6) || std::abs(count - whole) > StepTolerance)
  {
    reject("a uniform wavelength grid from ", first, " to ", last, " nm in steps of ", step,
      " nm does not end on its last value");
  }
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(whole) + 1);
  for (std::size_t i = 0; i <= static_cast<std::size_t>(whole); ++i)
  {
    values.push_back(first + step * static_cast<double>(i));
  }
  return WavelengthGrid(std::move(values));
}

std::optional<double> WavelengthGrid::commonStep() const noexcept
{
  if (Nanometres.size() < 2)
  {
    return std::nullopt;
  }
  const double mean =
    (Nanometres.back() - Nanometres.front()) / static_cast<double>(Nanometres.size() - 1);
  for (std::size_t i = 1; i < Nanometres.size(); ++i)
  {
    if (std::abs(Nanometres[i] - Nanometres[i - 1] - mean) > StepTolerance)
    {
      return std::nullopt;
    }
  }
  return mean;
}

} // namespace msi

#include "Kernels/Colorimetry/StandardObserver.h"

#include "Kernels/Colorimetry/StandardTables.h"

#include "Kernels/Spectra/Interpolation.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
const StandardTable& tableNamed(std::string_view name)
{
  const auto& tables = standardTables();
  return *std::find_if(
    tables.begin(), tables.end(), [name](const auto& table) { return table.name == name; });
}

// 1 nm apart, from the first wavelength as far as the last one allows; finer grids stay as they are.
WavelengthGrid integrationGrid(const WavelengthGrid& known)
{
  const double mean = (known.back() - known.front()) / static_cast<double>(known.size() - 1);
  if (known.size() < 2 || mean <= 1.0)
  {
    return known;
  }
  std::vector<double> nanometres;
  for (double i = 0.0; known.front() + i <= known.back(); i += 1.0)
  {
    nanometres.push_back(known.front() + i);
  }
  return WavelengthGrid(std::move(nanometres));
}
}

StandardObserver::StandardObserver(
  std::string name, WavelengthGrid wavelengths, Eigen::Matrix3Xd functions)
  : Name(std::move(name))
  , Wavelengths(std::move(wavelengths))
  , Functions(std::move(functions))
{
  std::ostringstream message;
  message << "observer '" << Name << "' ";
  if (Functions.cols() != Wavelengths.size())
  {
    message << "has " << Functions.cols() << " values of each function for " << Wavelengths.size()
            << " wavelengths; expected one each";
    throw std::invalid_argument(message.str());
  }
  for (Eigen::Index i = 0; i < Functions.cols(); ++i)
  {
    if (!Functions.col(i).allFinite())
    {
      message << "has a value that is not finite at " << Wavelengths[i] << " nm";
      throw std::invalid_argument(message.str());
    }
  }
  if (!(Functions.row(1).sum() > 0.0))
  {
    message << "has a second function (y-bar) without a positive sum; expected the columns x-bar, "
               "y-bar and z-bar in this order";
    throw std::invalid_argument(message.str());
  }
  const WavelengthGrid fine = integrationGrid(Wavelengths);
  if (fine != Wavelengths)
  {
    Functions = Functions *
      resamplingMatrix(Wavelengths, fine, InterpolationMethod::CubicLagrange).transpose();
    Wavelengths = fine;
  }
}

StandardObserver::StandardObserver(std::string name, std::string_view table)
  : Name(std::move(name))
  , Wavelengths(tableNamed(table).wavelengths())
  , Functions(tableNamed(table).values().rightCols<3>().transpose())
{
}

const StandardObserver& StandardObserver::cie1931TwoDegree()
{
  static const StandardObserver observer("CIE 1931 2 degree", "observer_CIE1931_2deg");
  return observer;
}

const StandardObserver& StandardObserver::cie1964TenDegree()
{
  static const StandardObserver observer("CIE 1964 10 degree", "observer_CIE1964_10deg");
  return observer;
}

const StandardObserver& StandardObserver::named(std::string_view name)
{
  if (name == "2" || name == cie1931TwoDegree().name())
  {
    return cie1931TwoDegree();
  }
  if (name == "10" || name == cie1964TenDegree().name())
  {
    return cie1964TenDegree();
  }
  std::string message = "unknown standard observer '" + std::string(name) + "'; known are:";
  for (const auto& known : names())
  {
    message += " '" + known + "'";
  }
  throw std::invalid_argument(message);
}

std::vector<std::string> StandardObserver::names()
{
  return { cie1931TwoDegree().name(), cie1964TenDegree().name() };
}

} // namespace msi

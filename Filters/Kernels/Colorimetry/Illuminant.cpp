#include "Kernels/Colorimetry/Illuminant.h"

#include "Kernels/Colorimetry/StandardTables.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr std::string_view TablePrefix = "illuminant_";

// The illuminant that a table holds; empty where it holds none.
std::string_view illuminantName(const StandardTable& table)
{
  if (table.name.substr(0, TablePrefix.size()) != TablePrefix)
  {
    return {};
  }
  return table.name.substr(TablePrefix.size());
}

std::string upperCase(std::string_view text)
{
  std::string result(text);
  for (char& letter : result)
  {
    if (letter >= 'a' && letter <= 'z')
    {
      letter = static_cast<char>(letter - 'a' + 'A');
    }
  }
  return result;
}

// F1..F12, as FL1..FL12 were called before CIE 15:2004.
std::string canonicalName(std::string_view name)
{
  std::string result = upperCase(name);
  if (result.size() > 1 && result[0] == 'F' && result[1] != 'L')
  {
    result.insert(1, "L");
  }
  return result;
}
}

Illuminant::Illuminant(std::string name, WavelengthGrid wavelengths, Eigen::VectorXd power,
  InterpolationMethod interpolation)
  : Name(std::move(name))
  , Wavelengths(std::move(wavelengths))
  , Power(std::move(power))
  , Interpolation(interpolation)
{
  std::ostringstream message;
  message << "illuminant '" << Name << "' ";
  if (Power.size() != Wavelengths.size())
  {
    message << "has " << Power.size() << " values of power for " << Wavelengths.size()
            << " wavelengths; expected one each";
    throw std::invalid_argument(message.str());
  }
  for (Eigen::Index i = 0; i < Power.size(); ++i)
  {
    if (!std::isfinite(Power(i)) || Power(i) < 0.0)
    {
      message << "has the power " << Power(i) << " at " << Wavelengths[i]
              << " nm; expected a finite value that is not negative";
      throw std::invalid_argument(message.str());
    }
  }
  if (Power.maxCoeff() <= 0.0)
  {
    message << "has no power at any wavelength";
    throw std::invalid_argument(message.str());
  }
}

Illuminant Illuminant::named(std::string_view name)
{
  const std::string wanted = canonicalName(name);
  for (const auto& table : standardTables())
  {
    if (!wanted.empty() && illuminantName(table) == wanted)
    {
      return Illuminant(wanted, WavelengthGrid(table.wavelengths()), table.values().col(1),
        wanted[0] == 'D' ? InterpolationMethod::Linear : InterpolationMethod::CubicLagrange);
    }
  }
  std::string message = "unknown illuminant '" + std::string(name) + "'; known are:";
  for (const auto& known : names())
  {
    message += ' ' + known;
  }
  throw std::invalid_argument(message + ", and F1 to F12 for FL1 to FL12");
}

Eigen::VectorXd Illuminant::powerAt(const WavelengthGrid& wavelengths) const
{
  Eigen::VectorXd result = resamplingMatrix(Wavelengths, wavelengths, Interpolation) * Power;
  for (Eigen::Index i = 0; i < result.size(); ++i)
  {
    if (wavelengths[i] < Wavelengths.front() || wavelengths[i] > Wavelengths.back())
    {
      result(i) = 0.0;
    }
  }
  return result;
}

std::vector<std::string> Illuminant::names()
{
  std::vector<std::string> result;
  for (const auto& table : standardTables())
  {
    const std::string_view name = illuminantName(table);
    if (!name.empty())
    {
      result.emplace_back(name);
    }
  }
  return result;
}

} // namespace msi

#include "Kernels/Colorimetry/Illuminant.h"

#include "Kernels/Colorimetry/StandardTables.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
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

// In capitals and without spaces.
std::string upperCase(std::string_view text)
{
  std::string result(text);
  result.erase(std::remove(result.begin(), result.end(), ' '), result.end());
  for (char& letter : result)
  {
    if (letter >= 'a' && letter <= 'z')
    {
      letter = static_cast<char>(letter - 'a' + 'A');
    }
  }
  return result;
}

// What the trade calls some of the CIE's lamps.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> TradeNames{
  { { "CWF", "FL2" }, { "TL83", "FL12" }, { "TL84", "FL11" }, { "TL85", "FL10" } }
};

// F1..F12, as FL1..FL12 were called before CIE 15:2004, and the names of the trade.
std::string canonicalName(std::string_view name)
{
  std::string result = upperCase(name);
  for (const auto& [trade, table] : TradeNames)
  {
    if (result == trade)
    {
      return std::string(table);
    }
  }
  if (result.size() > 1 && result[0] == 'F' && result[1] != 'L')
  {
    result.insert(1, "L");
  }
  return result;
}

// The number between a prefix and a suffix; nothing where the text is made differently.
std::optional<double> numberWithin(
  std::string_view text, std::string_view prefix, std::string_view suffix)
{
  if (text.size() <= prefix.size() + suffix.size() || text.substr(0, prefix.size()) != prefix ||
    text.substr(text.size() - suffix.size()) != suffix)
  {
    return std::nullopt;
  }
  text.remove_prefix(prefix.size());
  text.remove_suffix(suffix.size());
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
  {
    return std::nullopt;
  }
  return value;
}

void requireTemperature(const std::string& name, double kelvin, double least, double most)
{
  if (!(kelvin >= least && kelvin <= most))
  {
    reject("illuminant '", name, "' has the temperature ", kelvin, " K; expected ", least, " to ",
      most, " K");
  }
}

// CIE 15:2018, 4.1.2: chromaticity by temperature, the weights of the components by chromaticity.
Illuminant daylight(const std::string& name, double kelvin)
{
  requireTemperature(name, kelvin, 4000.0, 25000.0);
  const double t = 1000.0 / kelvin;
  const double x = kelvin <= 7000.0 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                                    : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
  const double y = (-3.000 * x + 2.870) * x - 0.275;
  const double scale = 0.0241 + 0.2562 * x - 0.7341 * y;
  const auto rounded = [](double weight) { return std::round(1000.0 * weight) / 1000.0; };
  const double first = rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / scale);
  const double second = rounded((0.0300 - 31.4424 * x + 30.0717 * y) / scale);
  const auto& tables = standardTables();
  const auto& components = *std::find_if(tables.begin(), tables.end(),
    [](const auto& table) { return table.name == "daylight_components"; });
  const auto values = components.values();
  return Illuminant(name, WavelengthGrid(components.wavelengths()),
    (values.col(1) + first * values.col(2) + second * values.col(3)).cwiseMax(0.0),
    InterpolationMethod::Linear);
}

// The grid on which illuminants that are formulas stand.
WavelengthGrid gridOfFormulas()
{
  return WavelengthGrid::uniform(300.0, 830.0, 5.0);
}

Illuminant blackbody(const std::string& name, double kelvin)
{
  requireTemperature(name, kelvin, 1000.0, 100000.0);
  constexpr double SecondRadiationConstant = 1.438776877e7; // nm K
  constexpr double NormalizedAt = 560.0;
  const auto radiance = [kelvin](double nm)
  { return std::pow(NormalizedAt / nm, 5) / std::expm1(SecondRadiationConstant / (nm * kelvin)); };
  const WavelengthGrid grid = gridOfFormulas();
  const Eigen::VectorXd power = grid.vector().unaryExpr(radiance);
  return Illuminant(name, grid, (100.0 / radiance(NormalizedAt)) * power);
}

// E, and the illuminants that a name gives a temperature.
std::optional<Illuminant> illuminantByFormula(const std::string& name)
{
  if (name == "E")
  {
    const WavelengthGrid grid = gridOfFormulas();
    return Illuminant(name, grid, Eigen::VectorXd::Constant(grid.size(), 100.0));
  }
  if (const auto kelvin = numberWithin(name, "BB", "K"))
  {
    return blackbody(name, *kelvin);
  }
  if (const auto kelvin = numberWithin(name, "D", "K"))
  {
    return daylight(name, *kelvin);
  }
  constexpr double ColdestDaylight = 4000.0;
  if (const auto kelvin = numberWithin(name, "", "K"); kelvin && *kelvin < ColdestDaylight)
  {
    return blackbody(name, *kelvin);
  }
  if (const auto kelvin = numberWithin(name, "D", ""); kelvin && *kelvin >= 1000.0)
  {
    return daylight(name, *kelvin);
  }
  if (const auto hundreds = numberWithin(name, "D", ""))
  {
    // The nominal temperature, from before c2 was 1.4388e-2 m K.
    return daylight(name, 100.0 * *hundreds * (1.4388 / 1.4380));
  }
  return std::nullopt;
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
  if (const auto byFormula = illuminantByFormula(wanted))
  {
    return *byFormula;
  }
  std::string message = "unknown illuminant '" + std::string(name) + "'; known are:";
  for (const auto& known : names())
  {
    message += ' ' + known;
  }
  throw std::invalid_argument(message +
    " E, F1 to F12 for FL1 to FL12, CWF TL83 TL84 TL85, D55 D75 and the like, and by temperature "
    "D5500K (daylight) and BB3200K (blackbody)");
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

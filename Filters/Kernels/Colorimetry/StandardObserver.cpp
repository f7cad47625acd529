#include "Kernels/Colorimetry/StandardObserver.h"

#include "Kernels/Colorimetry/StandardTables.h"

#include <algorithm>
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

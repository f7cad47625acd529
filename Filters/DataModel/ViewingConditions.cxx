#include "ViewingConditions.h"

#include "SampleColumns.h"

#include "Kernels/Spectra/Counted.h"

#include "vtkDataArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
// Color needs the curves here.
constexpr double ColorFrom = 400.0;
constexpr double ColorTo = 700.0;

struct Curve
{
  std::string name;
  WavelengthGrid wavelengths;
  Eigen::VectorXd values;
};

vtkDataArray* numbersOf(vtkTable* table, const char* column)
{
  auto* numbers = vtkDataArray::SafeDownCast(table->GetColumnByName(column));
  return numbers && numbers->GetNumberOfComponents() == 1 ? numbers : nullptr;
}

Curve curveOf(
  const std::string& nameOfTable, const std::string& name, vtkDataArray* nm, vtkDataArray* values)
{
  std::vector<std::pair<double, double>> points;
  for (vtkIdType row = 0; row < nm->GetNumberOfTuples(); ++row)
  {
    if (!std::isnan(values->GetComponent(row, 0)))
    {
      points.emplace_back(nm->GetComponent(row, 0), values->GetComponent(row, 0));
    }
  }
  std::sort(points.begin(), points.end());
  std::ostringstream message;
  message << nameOfTable << ": the curve '" << name << "' ";
  if (points.empty() || points.front().first > ColorFrom || points.back().first < ColorTo)
  {
    if (points.empty())
    {
      message << "has no value";
    }
    else
    {
      message << "covers " << points.front().first << " to " << points.back().first << " nm";
    }
    message << "; expected at least " << ColorFrom << " to " << ColorTo
            << " nm, which color depends on; measure it farther";
    throw std::invalid_argument(message.str());
  }
  std::vector<double> wavelengths;
  Eigen::VectorXd power(static_cast<Eigen::Index>(points.size()));
  for (const auto& [at, value] : points)
  {
    power(static_cast<Eigen::Index>(wavelengths.size())) = value;
    wavelengths.push_back(at);
  }
  try
  {
    return { name, WavelengthGrid(std::move(wavelengths)), std::move(power) };
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(message.str() + "has bad wavelengths: " + error.what());
  }
}

std::vector<Curve> curvesOf(vtkTable* table, const std::string& nameOfTable)
{
  std::vector<Curve> curves;
  auto* nm = numbersOf(table, WavelengthColumn);
  for (vtkIdType i = 0; nm && i < table->GetNumberOfColumns(); ++i)
  {
    const char* name = table->GetColumnName(i);
    auto* values = name ? numbersOf(table, name) : nullptr;
    if (values && values != nm)
    {
      curves.push_back(curveOf(nameOfTable, name, nm, values));
    }
  }
  if (curves.empty())
  {
    throw std::invalid_argument(nameOfTable +
      (nm ? " has no curve" : std::string(" has no column of numbers '") + WavelengthColumn + "'") +
      "; expected the column 'wavelength' (nm) and one column of numbers a curve");
  }
  return curves;
}

StandardObserver observerOf(vtkTable* table, const std::string& name)
{
  if (!table)
  {
    return StandardObserver::named(name);
  }
  const std::string nameOfTable = "the observer's table";
  const auto curves = curvesOf(table, nameOfTable);
  const bool same = std::all_of(curves.begin(), curves.end(),
    [&](const Curve& curve) { return curve.wavelengths == curves.front().wavelengths; });
  if (curves.size() != 3 || !same)
  {
    throw std::invalid_argument(nameOfTable + " has " +
      msi::counted(static_cast<std::ptrdiff_t>(curves.size()), "curve") +
      (same ? "" : " over different wavelengths") +
      "; expected three over the same wavelengths: x-bar, y-bar and z-bar, in this order");
  }
  Eigen::Matrix3Xd functions(3, curves.front().values.size());
  for (Eigen::Index i = 0; i < 3; ++i)
  {
    functions.row(i) = curves[static_cast<std::size_t>(i)].values.transpose();
  }
  return StandardObserver("of the table", curves.front().wavelengths, std::move(functions));
}
}

ViewingConditions::ViewingConditions(
  vtkTable* illuminants, vtkTable* observer, const std::string& observerName)
  : Observer(observerOf(observer, observerName))
{
  if (!illuminants)
  {
    return;
  }
  for (auto& curve : curvesOf(illuminants, "the illuminants' table"))
  {
    Own.emplace_back(std::move(curve.name), std::move(curve.wavelengths), std::move(curve.values));
  }
}

Illuminant ViewingConditions::illuminant(const std::string& name) const
{
  const auto found = std::find_if(
    Own.begin(), Own.end(), [&name](const Illuminant& own) { return own.name() == name; });
  if (found != Own.end())
  {
    return *found;
  }
  try
  {
    return Illuminant::named(name);
  }
  catch (const std::invalid_argument& error)
  {
    std::string message = error.what();
    for (const Illuminant& own : Own)
    {
      message += (&own == &Own.front() ? "; the illuminants' table has '" : "', '") + own.name();
    }
    throw std::invalid_argument(message + (Own.empty() ? "" : "'"));
  }
}

} // namespace msi

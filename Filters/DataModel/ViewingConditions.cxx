#include "ViewingConditions.h"

#include "CurveTable.h"
#include "NameList.h"
#include "SampleColumns.h"

#include "Kernels/Spectra/Counted.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
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

std::vector<Curve> curvesOfFile(const std::string& file)
{
  vtkNew<vtkTable> table;
  readCurveTable({ file }, table);
  return curvesOf(table, file);
}

StandardObserver observerOf(vtkTable* table, const std::string& file, const std::string& name)
{
  if (!table && file.empty())
  {
    return StandardObserver::named(name);
  }
  if (table && !file.empty())
  {
    throw std::invalid_argument("the observer is given as Observer Table and as Observer File (" +
      file + "); expected one of them; clear the other");
  }
  const std::string nameOfTable = table ? "the observer's table" : file;
  const auto curves = table ? curvesOf(table, nameOfTable) : curvesOfFile(file);
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
  return StandardObserver(
    table ? "of the table" : "of the file", curves.front().wavelengths, std::move(functions));
}
}

ViewingConditions::ViewingConditions(vtkTable* illuminants, vtkTable* observer,
  const std::string& observerName, const ViewingFiles& files)
  : Observer(observerOf(observer, files.observer, observerName))
{
  const auto add = [this](Curve& curve) {
    Own.emplace_back(std::move(curve.name), std::move(curve.wavelengths), std::move(curve.values));
  };
  if (illuminants)
  {
    for (auto& curve : curvesOf(illuminants, "the illuminants' table"))
    {
      add(curve);
    }
  }
  if (files.illuminants.empty())
  {
    return;
  }
  for (auto& curve : curvesOfFile(files.illuminants))
  {
    if (findOwn(curve.name))
    {
      throw std::invalid_argument(files.illuminants + ": the illuminant '" + curve.name +
        "' is also in the illuminants' table; expected different names; rename the file or the "
        "column");
    }
    NamesOfFile.push_back(curve.name);
    add(curve);
  }
}

const Illuminant* ViewingConditions::findOwn(const std::string& name) const
{
  const auto found = std::find_if(
    Own.begin(), Own.end(), [&name](const Illuminant& own) { return own.name() == name; });
  return found == Own.end() ? nullptr : &*found;
}

std::vector<std::string> ViewingConditions::withFile(std::vector<std::string> names) const
{
  for (const auto& name : NamesOfFile)
  {
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  }
  return names;
}

Illuminant ViewingConditions::illuminant(const std::string& name) const
{
  if (const Illuminant* own = findOwn(name))
  {
    return *own;
  }
  try
  {
    return Illuminant::named(name);
  }
  catch (const std::invalid_argument& error)
  {
    std::vector<std::string> names;
    for (const Illuminant& own : Own)
    {
      names.push_back(own.name());
    }
    throw std::invalid_argument(error.what() +
      (names.empty() ? std::string() : "; illuminants of your own are " + quotedNames(names)));
  }
}

} // namespace msi

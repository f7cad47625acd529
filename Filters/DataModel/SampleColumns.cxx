#include "SampleColumns.h"

#include "UsefulData.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include "Kernels/Doubts/SampleDoubts.h"
#include "Kernels/Spectra/PossibleValues.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{

struct Column
{
  double number;
  vtkDataArray* values;
};

std::optional<double> numberInName(const std::string& name, char letter)
{
  if (name.size() < 2 || name[0] != letter)
  {
    return std::nullopt;
  }
  double number = 0.0;
  const char* end = name.data() + name.size();
  const auto parsed = std::from_chars(name.data() + 1, end, number, std::chars_format::fixed);
  if (parsed.ec != std::errc() || parsed.ptr != end)
  {
    return std::nullopt;
  }
  return number;
}

const char* wordFor(SampleQuantity quantity)
{
  switch (quantity)
  {
    case SampleQuantity::Reflectance:
      return "measured reflectance (R400, R410, ..)";
    case SampleQuantity::Response:
      return "camera responses (C400, C420, .. or C1, C2, ..)";
    case SampleQuantity::Estimate:
      return "estimated reflectance (E400, E410, ..)";
    case SampleQuantity::Uncertainty:
      return "uncertainty (U400, U410, ..)";
  }
  return "";
}

std::vector<Column> columnsOf(vtkTable* table, char letter)
{
  std::vector<Column> columns;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    const char* name = table->GetColumnName(i);
    const auto number = name ? numberInName(name, letter) : std::nullopt;
    if (!number)
    {
      continue;
    }
    auto* values = vtkDataArray::SafeDownCast(table->GetColumn(i));
    if (!values || values->GetNumberOfComponents() != 1)
    {
      throw std::invalid_argument(
        std::string("column '") + name + "' is not a column of numbers, one per sample");
    }
    columns.push_back({ *number, values });
  }
  std::sort(columns.begin(), columns.end(),
    [](const Column& a, const Column& b) { return a.number < b.number; });
  for (std::size_t i = 1; i < columns.size(); ++i)
  {
    if (columns[i].number == columns[i - 1].number)
    {
      throw std::invalid_argument(std::string("columns '") + columns[i - 1].values->GetName() +
        "' and '" + columns[i].values->GetName() + "' name the same wavelength");
    }
  }
  return columns;
}
}

std::optional<SampleSpectra> findSpectra(vtkTable* table, SampleQuantity quantity)
{
  const auto columns = columnsOf(table, static_cast<char>(quantity));
  if (columns.empty())
  {
    return std::nullopt;
  }
  SampleSpectra spectra;
  if (columns.front().number >= FirstWavelength)
  {
    std::vector<double> wavelengths;
    wavelengths.reserve(columns.size());
    for (const auto& column : columns)
    {
      wavelengths.push_back(column.number);
    }
    spectra.axis = axisOf(WavelengthGrid(std::move(wavelengths)));
  }
  else if (quantity != SampleQuantity::Response)
  {
    throw std::invalid_argument(std::string("column '") + columns.front().values->GetName() +
      "' is no wavelength; expected " + wordFor(quantity) + " from 100 nm on");
  }
  else
  {
    for (const auto& column : columns)
    {
      spectra.axis.names.emplace_back(column.values->GetName());
    }
  }
  for (const auto& column : columns)
  {
    spectra.columns.emplace_back(column.values->GetName());
  }
  const auto rows = table->GetNumberOfRows();
  spectra.values.resize(static_cast<Eigen::Index>(columns.size()), rows);
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    for (vtkIdType row = 0; row < rows; ++row)
    {
      spectra.values(static_cast<Eigen::Index>(i), row) = columns[i].values->GetComponent(row, 0);
    }
  }
  return spectra;
}

SampleSpectra requireSpectra(
  vtkTable* table, SampleQuantity quantity, const std::string& nameOfTable)
{
  if (!table || table->GetNumberOfRows() == 0)
  {
    throw std::invalid_argument(nameOfTable + " is empty; expected a table of samples");
  }
  auto spectra = findSpectra(table, quantity);
  if (!spectra)
  {
    throw std::invalid_argument(nameOfTable + " has no columns of " + wordFor(quantity) +
      "; it has " + std::to_string(table->GetNumberOfColumns()) + " other columns");
  }
  return std::move(*spectra);
}

void setNumbers(
  vtkTable* table, const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& values)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name.c_str());
  column->SetNumberOfValues(values.size());
  std::copy(values.begin(), values.end(), column->GetPointer(0));
  table->RemoveColumnByName(name.c_str());
  table->AddColumn(column);
}

void setSpectra(vtkTable* table, SampleQuantity quantity, const SpectralAxis& axis,
  const Eigen::Ref<const Eigen::MatrixXd>& values)
{
  // VTK looks through all columns whenever a named one is added, and moves all of them where there is no room: named
  // afterwards and with room made before, thousands of them cost no more than their number.
  std::set<std::string> present;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    const char* name = table->GetColumnName(i);
    present.insert(name ? name : "");
  }
  auto* columns = table->GetRowData();
  columns->AllocateArrays(columns->GetNumberOfArrays() + static_cast<int>(axis.size()));
  std::vector<vtkSmartPointer<vtkDoubleArray>> added;
  for (std::size_t i = 0; i < axis.size(); ++i)
  {
    const std::string name =
      axis.wavelengths ? static_cast<char>(quantity) + axis.names[i] : axis.names[i];
    if (present.count(name) > 0)
    {
      table->RemoveColumnByName(name.c_str());
    }
    auto column = vtkSmartPointer<vtkDoubleArray>::New();
    column->SetNumberOfValues(values.cols());
    const auto row = values.row(static_cast<Eigen::Index>(i));
    std::copy(row.begin(), row.end(), column->GetPointer(0));
    table->AddColumn(column);
    added.push_back(column);
  }
  for (std::size_t i = 0; i < axis.size(); ++i)
  {
    added[i]->SetName(
      (axis.wavelengths ? static_cast<char>(quantity) + axis.names[i] : axis.names[i]).c_str());
  }
}

MeasuredSamples readSamples(vtkTable* table, const std::string& nameOfTable)
{
  auto reflectance = requireSpectra(table, SampleQuantity::Reflectance, nameOfTable);
  auto response = requireSpectra(table, SampleQuantity::Response, nameOfTable);
  MeasuredSamples measured{ nameOfTable, std::move(reflectance.axis), std::move(response.axis),
    { std::move(reflectance.values), std::move(response.values) }, sampleNames(table, "row "), {},
    {} };
  auto* x = vtkDataArray::SafeDownCast(table->GetColumnByName("x"));
  auto* y = vtkDataArray::SafeDownCast(table->GetColumnByName("y"));
  if (x && y)
  {
    measured.x.resize(measured.samples.size());
    measured.y.resize(measured.samples.size());
    for (Eigen::Index i = 0; i < measured.x.size(); ++i)
    {
      measured.x[i] = x->GetComponent(i, 0);
      measured.y[i] = y->GetComponent(i, 0);
    }
  }
  requirePossibleReflectance(measured.samples.reflectance, nameOfTable);
  requirePossibleResponse(measured.samples.response, nameOfTable);
  requireResponsesThatChange(measured.samples.response, nameOfTable);
  return measured;
}

MeasuredSamples requireMeasuredSamples(vtkTable* table, const std::string& nameOfTable)
{
  MeasuredSamples measured = readSamples(table, nameOfTable);
  requireValid(measured.samples, nameOfTable);
  return measured;
}

void requireAlike(const MeasuredSamples& a, const MeasuredSamples& b)
{
  requireSameChannels(a.channels, a.table, b.channels, b.table);
  requireSameBands(a.bands, a.table, b.bands, b.table);
  const double ofA = typicalLevel(a.samples.response);
  const double ofB = typicalLevel(b.samples.response);
  if ((ofA > LargestRelativeLevel) != (ofB > LargestRelativeLevel))
  {
    std::ostringstream message;
    message << "the responses of " << a.table << " reach " << ofA << ", those of " << b.table << " "
            << ofB
            << " (median of the channels); expected both relative to white, or both in counts; "
               "divide the counts "
            << "by those of the perfect white";
    throw std::invalid_argument(message.str());
  }
}

namespace
{
// Those with finite values.
NamedSamples named(const MeasuredSamples& samples)
{
  NamedSamples finite{ {}, samples.table, {}, {}, {} };
  std::vector<Eigen::Index> columns;
  for (Eigen::Index i = 0; i < samples.samples.size(); ++i)
  {
    if (samples.samples.reflectance.col(i).allFinite() &&
      samples.samples.response.col(i).allFinite())
    {
      columns.push_back(i);
      finite.names.push_back(samples.names[static_cast<std::size_t>(i)]);
    }
  }
  finite.set = samples.samples.subset(columns);
  if (samples.x.size() > 0 && samples.x(columns).isFinite().all() &&
    samples.y(columns).isFinite().all())
  {
    finite.x = samples.x(columns);
    finite.y = samples.y(columns);
  }
  return finite;
}
}

std::vector<std::string> doubtsOf(const MeasuredSamples& chart, const MeasuredSamples* medium)
{
  std::vector<std::string> channels;
  for (std::size_t k = 0; k < chart.channels.size(); ++k)
  {
    channels.push_back(nameOf(chart.channels, k));
  }
  if (medium == nullptr)
  {
    return doubtsOf(named(chart), channels);
  }
  const NamedSamples ofMedium = named(*medium);
  return doubtsOf(named(chart), channels, &ofMedium);
}

std::vector<std::string> sampleNames(vtkTable* table, const std::string& beforeNumber)
{
  auto* column = table->GetColumnByName("sample");
  std::vector<std::string> names;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    names.push_back(
      column ? column->GetVariantValue(row).ToString() : beforeNumber + std::to_string(row + 1));
  }
  return names;
}

void copyRows(vtkTable* from, const std::vector<Eigen::Index>& rows, vtkTable* to)
{
  auto* source = from->GetRowData();
  auto* target = to->GetRowData();
  target->CopyAllOn();
  target->CopyAllocate(source, static_cast<vtkIdType>(rows.size()));
  vtkIdType next = 0;
  for (const auto row : rows)
  {
    target->CopyData(source, row, next++);
  }
  // An empty choice still has the columns.
  target->SetNumberOfTuples(next);
  to->GetFieldData()->PassData(from->GetFieldData());
}

} // namespace msi

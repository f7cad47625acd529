#include "CameraTable.h"

#include "SampleColumns.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace msi
{

namespace
{
constexpr const char* DarkArray = "Dark";
constexpr const char* NoiseArray = "Noise";
constexpr const char* EffectsArray = "Effects";
constexpr const char* WhiteAfterEffectsArray = "WhiteAfterEffects";

void addField(vtkDataObject* table, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  table->GetFieldData()->AddArray(array);
}

std::vector<double> field(vtkTable* table, const char* name, const std::string& nameOfTable)
{
  auto* array = table->GetFieldData()->GetAbstractArray(name);
  if (!array)
  {
    return {};
  }
  auto* numbers = vtkDataArray::SafeDownCast(array);
  std::vector<double> values;
  for (vtkIdType i = 0; numbers && i < numbers->GetNumberOfTuples(); ++i)
  {
    for (int j = 0; j < numbers->GetNumberOfComponents(); ++j)
    {
      values.push_back(numbers->GetComponent(i, j));
      if (!std::isfinite(values.back()))
      {
        throw std::invalid_argument(
          nameOfTable + ": the field data '" + name + "' hold a number that is not finite");
      }
    }
  }
  if (!numbers)
  {
    throw std::invalid_argument(nameOfTable + ": the field data '" + name + "' are no numbers");
  }
  return values;
}

std::optional<CameraNoise> noiseOf(vtkTable* table, const std::string& nameOfTable)
{
  std::vector<double> values = field(table, NoiseArray, nameOfTable);
  if (values.empty())
  {
    return std::nullopt;
  }
  constexpr std::size_t Least = 2;
  constexpr std::size_t Most = 5;
  if (values.size() < Least || values.size() > Most ||
    std::any_of(values.begin(), values.end(), [](double value) { return value < 0.0; }))
  {
    throw std::invalid_argument(nameOfTable + ": the field data '" + NoiseArray + "' are " +
      std::to_string(values.size()) +
      " numbers; expected read and shot, or those with fixed pattern gain, fixed pattern offset "
      "and quantisation step, each from 0 up");
  }
  values.resize(Most, 0.0);
  return CameraNoise{ values[0], values[1], values[2], values[3], values[4] };
}

Eigen::VectorXd darkOf(vtkTable* table, std::size_t channels, const std::string& nameOfTable)
{
  std::vector<double> dark = field(table, DarkArray, nameOfTable);
  if (dark.size() <= 1)
  {
    dark.assign(channels, dark.empty() ? 0.0 : dark[0]);
  }
  if (dark.size() != channels)
  {
    throw std::invalid_argument(nameOfTable + ": the field data '" + DarkArray + "' have " +
      std::to_string(dark.size()) + " values; expected one, or " + std::to_string(channels) +
      " as there are channels");
  }
  return Eigen::Map<const Eigen::VectorXd>(dark.data(), static_cast<Eigen::Index>(dark.size()));
}

// The rows by increasing wavelength.
std::vector<vtkIdType> sortedRows(vtkDataArray* wavelength)
{
  std::vector<vtkIdType> rows(static_cast<std::size_t>(wavelength->GetNumberOfTuples()));
  std::iota(rows.begin(), rows.end(), vtkIdType{ 0 });
  std::sort(rows.begin(), rows.end(),
    [&](vtkIdType a, vtkIdType b)
    { return wavelength->GetComponent(a, 0) < wavelength->GetComponent(b, 0); });
  return rows;
}

vtkDataArray* requireNumbers(vtkTable* table, vtkIdType column, const std::string& nameOfTable)
{
  auto* numbers = vtkDataArray::SafeDownCast(table->GetColumn(column));
  if (!numbers || numbers->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(nameOfTable + ": the column '" +
      std::string(table->GetColumnName(column)) +
      "' is not a column of numbers; expected wavelength and one curve a channel");
  }
  return numbers;
}

std::optional<double> wavelengthInName(const std::string& name)
{
  const char* begin = name.data() + (name.size() > 1 && name[0] == 'C' ? 1 : 0);
  const char* end = name.data() + name.size();
  double value = 0.0;
  const auto parsed = std::from_chars(begin, end, value, std::chars_format::fixed);
  const std::string rest(parsed.ptr, end);
  if (parsed.ec != std::errc() || !(rest.empty() || rest == "nm") || value < FirstWavelength)
  {
    return std::nullopt;
  }
  return value;
}
}

void write(const CameraTable& description, vtkTable* table)
{
  const CameraModel& camera = description.camera;
  table->Initialize();
  setNumbers(table, WavelengthColumn, camera.wavelengths().vector());
  for (Eigen::Index k = 0; k < camera.channelCount(); ++k)
  {
    setNumbers(table, camera.channels()[static_cast<std::size_t>(k)],
      camera.responsivity().row(k).transpose());
  }
  addField(table, DarkArray, { camera.dark().begin(), camera.dark().end() });
  if (const auto& noise = description.noise)
  {
    std::vector<double> values = { noise->read, noise->shot };
    const std::array<double, 3> rest = { noise->fixedPatternGain, noise->fixedPatternOffset,
      noise->quantisationStep };
    if (std::any_of(rest.begin(), rest.end(), [](double value) { return value != 0.0; }))
    {
      values.insert(values.end(), rest.begin(), rest.end());
    }
    addField(table, NoiseArray, values);
  }
  if (!description.effects.empty())
  {
    vtkNew<vtkStringArray> effects;
    effects->SetName(EffectsArray);
    effects->InsertNextValue(description.effects);
    table->GetFieldData()->AddArray(effects);
  }
  if (description.whiteAfterEffects)
  {
    vtkNew<vtkIntArray> flag;
    flag->SetName(WhiteAfterEffectsArray);
    flag->InsertNextValue(1);
    table->GetFieldData()->AddArray(flag);
  }
  setWhiteLevel(table, description.whiteLevel);
}

void setWhiteLevel(vtkDataObject* data, double whiteLevel)
{
  data->GetFieldData()->RemoveArray(WhiteLevelArray);
  if (whiteLevel != 1.0)
  {
    addField(data, WhiteLevelArray, { whiteLevel });
  }
}

CameraTable readCamera(vtkTable* table, const std::string& nameOfTable)
{
  if (!table || table->GetNumberOfRows() == 0)
  {
    throw std::invalid_argument(
      nameOfTable + " is empty; expected a table with wavelength and one curve a channel");
  }
  auto* wavelength = vtkDataArray::SafeDownCast(table->GetColumnByName(WavelengthColumn));
  if (!wavelength || wavelength->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(nameOfTable + " has no column of numbers '" + WavelengthColumn +
      "'; expected wavelength and one curve a channel");
  }
  const std::vector<vtkIdType> rows = sortedRows(wavelength);
  std::vector<double> nanometres;
  std::transform(rows.begin(), rows.end(), std::back_inserter(nanometres),
    [&](vtkIdType row) { return wavelength->GetComponent(row, 0); });
  const WavelengthGrid grid(std::move(nanometres));
  if (grid.size() > 1 && !grid.step())
  {
    throw std::invalid_argument(
      nameOfTable + ": the wavelengths are no uniform grid; interpolate the curves");
  }
  std::vector<std::string> names;
  std::vector<vtkDataArray*> curves;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    if (table->GetColumn(i) != wavelength)
    {
      curves.push_back(requireNumbers(table, i, nameOfTable));
      names.emplace_back(table->GetColumnName(i));
    }
  }
  if (curves.empty())
  {
    throw std::invalid_argument(
      nameOfTable + " has no curve; expected one column a channel beside wavelength");
  }
  Eigen::MatrixXd responsivity(static_cast<Eigen::Index>(curves.size()), grid.size());
  for (Eigen::Index k = 0; k < responsivity.rows(); ++k)
  {
    for (Eigen::Index j = 0; j < responsivity.cols(); ++j)
    {
      responsivity(k, j) =
        curves[static_cast<std::size_t>(k)]->GetComponent(rows[static_cast<std::size_t>(j)], 0);
    }
  }
  Eigen::VectorXd dark = darkOf(table, names.size(), nameOfTable);
  CameraTable camera{ { grid, std::move(responsivity), std::move(dark), std::move(names) },
    noiseOf(table, nameOfTable) };
  auto* effects =
    vtkStringArray::SafeDownCast(table->GetFieldData()->GetAbstractArray(EffectsArray));
  if (effects && effects->GetNumberOfValues() > 0)
  {
    camera.effects = effects->GetValue(0);
  }
  const std::vector<double> flag = field(table, WhiteAfterEffectsArray, nameOfTable);
  camera.whiteAfterEffects = !flag.empty() && flag[0] != 0.0;
  if (const std::vector<double> level = field(table, WhiteLevelArray, nameOfTable); !level.empty())
  {
    if (level.size() != 1 || !(level[0] > 0.0))
    {
      throw std::invalid_argument(
        nameOfTable + ": the field data '" + WhiteLevelArray + "' are not one number above 0");
    }
    camera.whiteLevel = level[0];
  }
  return camera;
}

SpectralAxis channelsOf(const CameraModel& camera)
{
  std::vector<double> nanometres;
  SpectralAxis numbered;
  for (const std::string& name : camera.channels())
  {
    const auto value = wavelengthInName(name);
    if (value && (nanometres.empty() || *value > nanometres.back()))
    {
      nanometres.push_back(*value);
    }
    numbered.names.push_back("C" + std::to_string(numbered.names.size() + 1));
  }
  return nanometres.size() == numbered.size() ? axisOf(WavelengthGrid(std::move(nanometres)))
                                              : numbered;
}

} // namespace msi

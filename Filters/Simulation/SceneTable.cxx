#include "SceneTable.h"

#include "SampleColumns.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include "Kernels/Spectra/Interpolation.h"

#include <stdexcept>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
std::vector<std::string> words(vtkTable* table, const char* name)
{
  std::vector<std::string> values;
  if (auto* column = table->GetColumnByName(name))
  {
    for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
    {
      values.push_back(column->GetVariantValue(row).ToString());
    }
  }
  return values;
}

Eigen::VectorXd numbers(vtkTable* table, const char* name, const std::string& nameOfTable)
{
  auto* column = table->GetColumnByName(name);
  if (!column)
  {
    return {};
  }
  auto* data = vtkDataArray::SafeDownCast(column);
  if (!data || data->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(
      nameOfTable + ": the column '" + name + "' is not a column of numbers, one per sample");
  }
  Eigen::VectorXd values(table->GetNumberOfRows());
  for (Eigen::Index row = 0; row < values.size(); ++row)
  {
    values[row] = data->GetComponent(row, 0);
  }
  return values;
}
}

SampleScene sceneOf(
  vtkTable* table, const WavelengthGrid& wavelengths, const std::string& nameOfTable)
{
  auto reflectance = requireSpectra(table, SampleQuantity::Reflectance, nameOfTable);
  SceneSamples samples{ std::move(reflectance.values), words(table, "medium"),
    words(table, "scene"), numbers(table, "x", nameOfTable), numbers(table, "y", nameOfTable),
    numbers(table, "order", nameOfTable) };
  const WavelengthGrid& grid = *reflectance.axis.wavelengths;
  if (grid != wavelengths)
  {
    samples.reflectance = (resamplingMatrix(grid, wavelengths) * samples.reflectance).eval();
  }
  return { wavelengths, std::move(samples) };
}

} // namespace msi

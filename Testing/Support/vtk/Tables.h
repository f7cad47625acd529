// Small vtkTables for tests.
#pragma once

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace msi::testing
{

inline void addColumn(vtkTable* table, const std::string& name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name.c_str());
  for (const double value : values)
  {
    column->InsertNextValue(value);
  }
  table->AddColumn(column);
}

inline void addTextColumn(
  vtkTable* table, const std::string& name, const std::vector<std::string>& values)
{
  vtkNew<vtkStringArray> column;
  column->SetName(name.c_str());
  for (const auto& value : values)
  {
    column->InsertNextValue(value);
  }
  table->AddColumn(column);
}

struct NamedColumn
{
  std::string name;
  std::vector<double> values;
};

inline vtkSmartPointer<vtkTable> newTable(std::initializer_list<NamedColumn> columns)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  for (const auto& column : columns)
  {
    addColumn(table, column.name, column.values);
  }
  return table;
}

// One column per row of the matrix, named by the letter and the wavelengths: "R400", ...
inline void addSpectra(
  vtkTable* table, char letter, const WavelengthGrid& wavelengths, const Eigen::MatrixXd& values)
{
  for (Eigen::Index i = 0; i < wavelengths.size(); ++i)
  {
    const Eigen::VectorXd row = values.row(i);
    addColumn(table, letter + std::to_string(static_cast<int>(wavelengths[i])),
      std::vector<double>(row.begin(), row.end()));
  }
}

inline vtkSmartPointer<vtkTable> newSampleTable(
  const SampleSet& samples, const WavelengthGrid& bands, const WavelengthGrid& channels)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  addSpectra(table, 'R', bands, samples.reflectance);
  addSpectra(table, 'C', channels, samples.response);
  return table;
}

inline double cell(vtkTable* table, vtkIdType row, const std::string& name)
{
  auto* column = vtkDataArray::SafeDownCast(table->GetColumnByName(name.c_str()));
  if (!column || row >= column->GetNumberOfTuples())
  {
    ADD_FAILURE() << "no number in column '" << name << "', row " << row;
    return 0.0;
  }
  return column->GetComponent(row, 0);
}

inline std::string textCell(vtkTable* table, vtkIdType row, const std::string& name)
{
  auto* column = table->GetColumnByName(name.c_str());
  if (!column || row >= column->GetNumberOfTuples())
  {
    ADD_FAILURE() << "nothing in column '" << name << "', row " << row;
    return {};
  }
  return column->GetVariantValue(row).ToString();
}

inline std::vector<std::string> columnNames(vtkTable* table)
{
  std::vector<std::string> names;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    names.emplace_back(table->GetColumnName(i));
  }
  return names;
}

} // namespace msi::testing

#include "FitSummaryTable.h"

#include "vtkTable.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

namespace msi
{

namespace
{
void addText(vtkTable* table, const char* name, const std::string& value)
{
  vtkNew<vtkStringArray> column;
  column->SetName(name);
  column->InsertNextValue(value);
  table->AddColumn(column);
}

void addNumber(vtkTable* table, const char* name, double value)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  column->InsertNextValue(value);
  table->AddColumn(column);
}

void addCount(vtkTable* table, const char* name, Eigen::Index value)
{
  vtkNew<vtkIntArray> column;
  column->SetName(name);
  column->InsertNextValue(static_cast<int>(value));
  table->AddColumn(column);
}
}

void write(const std::string& method, const FitSummary& summary, vtkTable* table)
{
  addText(table, "method", method);
  addCount(table, "samples", summary.samples);
  addCount(table, "unknowns", summary.unknowns);
  addCount(table, "rank", summary.rank);
  if (summary.condition > 0.0)
  {
    addNumber(table, "condition", summary.condition);
  }
  addCount(table, "iterations", summary.iterations);
  addNumber(table, "residual_rms", summary.residualRms);
  addCount(table, "complete", summary.complete ? 1 : 0);
  addText(table, "status", summary.status);
}

} // namespace msi

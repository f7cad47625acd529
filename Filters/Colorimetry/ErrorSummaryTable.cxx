#include "ErrorSummaryTable.h"

#include "vtkDoubleArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

namespace msi
{

ErrorSummaryTable::ErrorSummaryTable(vtkTable* table)
{
  const char* names[] = { "mean", "median", "p95", "max", "count", "left_out" };
  Metric->SetName("metric");
  Illuminant->SetName("illuminant");
  table->AddColumn(Metric);
  table->AddColumn(Illuminant);
  for (int i = 0; i < 6; ++i)
  {
    Figures[i]->SetName(names[i]);
    table->AddColumn(Figures[i]);
  }
}

ErrorSummaryTable::~ErrorSummaryTable() = default;

void ErrorSummaryTable::add(const ErrorName& name, const ErrorSummary& summary)
{
  Metric->InsertNextValue(name.metric);
  Illuminant->InsertNextValue(name.illuminant);
  const double figures[] = { summary.mean, summary.median, summary.p95, summary.max,
    static_cast<double>(summary.count), static_cast<double>(summary.nonFinite) };
  for (int i = 0; i < 6; ++i)
  {
    Figures[i]->InsertNextValue(figures[i]);
  }
}

} // namespace msi

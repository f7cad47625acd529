// The figures of error statistics as a vtkTable.
#ifndef ErrorSummaryTable_h
#define ErrorSummaryTable_h

#include "NameList.h"

#include "vtkNew.h"

#include "Kernels/Difference/ErrorSummary.h"

class vtkDoubleArray;
class vtkStringArray;
class vtkTable;

namespace msi
{

// One row a metric: metric, illuminant, mean, median, p95, max, count, left_out (not finite).
class ErrorSummaryTable
{
public:
  explicit ErrorSummaryTable(vtkTable* table);
  ~ErrorSummaryTable();
  ErrorSummaryTable(const ErrorSummaryTable&) = delete;
  ErrorSummaryTable& operator=(const ErrorSummaryTable&) = delete;

  void add(const ErrorName& name, const ErrorSummary& summary);

private:
  vtkNew<vtkStringArray> Metric;
  vtkNew<vtkStringArray> Illuminant;
  vtkNew<vtkDoubleArray> Figures[6];
};

} // namespace msi

#endif

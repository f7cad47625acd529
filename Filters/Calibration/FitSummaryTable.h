// A fit's summary as a vtkTable of one row.
#ifndef FitSummaryTable_h
#define FitSummaryTable_h

#include "Kernels/Numerics/FitSummary.h"

#include <string>

class vtkTable;

namespace msi
{

// Columns: method, samples, unknowns, rank, condition, iterations, residual_rms, complete, status.
void write(const std::string& method, const FitSummary& summary, vtkTable* table);

} // namespace msi

#endif

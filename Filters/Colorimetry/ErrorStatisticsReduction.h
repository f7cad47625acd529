// Error statistics of arrays that are spread over the pieces of several ranks.
#ifndef ErrorStatisticsReduction_h
#define ErrorStatisticsReduction_h

#include "Kernels/Difference/ErrorSummary.h"

#include <cstdint>
#include <vector>

class vtkFloatArray;
class vtkMultiProcessController;

namespace msi
{

// The summary of all values of all ranks; the same bytes for any number of ranks and any split.
// 'controller' null: this process holds everything. Collective otherwise.
ErrorSummary summarize(vtkFloatArray* values, vtkMultiProcessController* controller);

// The states of statistics, summed element by element over the ranks. 'controller' null: 'mine'.
// Collective otherwise.
std::vector<std::int64_t> sumOverRanks(
  const std::vector<std::int64_t>& mine, vtkMultiProcessController* controller);

} // namespace msi

#endif

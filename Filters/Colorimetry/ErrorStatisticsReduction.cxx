#include "ErrorStatisticsReduction.h"

#include "vtkCommunicator.h"
#include "vtkFloatArray.h"
#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include "Kernels/Difference/ErrorOrderStatistics.h"

#include <vector>

namespace msi
{

std::vector<std::int64_t> sumOverRanks(
  const std::vector<std::int64_t>& mine, vtkMultiProcessController* controller)
{
  if (!controller)
  {
    return mine;
  }
  static_assert(sizeof(vtkIdType) == sizeof(std::int64_t), "built with 64-bit ids");
  const std::vector<vtkIdType> sent(mine.begin(), mine.end());
  std::vector<vtkIdType> all(sent.size());
  controller->AllReduce(
    sent.data(), all.data(), static_cast<vtkIdType>(sent.size()), vtkCommunicator::SUM_OP);
  return std::vector<std::int64_t>(all.begin(), all.end());
}

ErrorSummary summarize(vtkFloatArray* values, vtkMultiProcessController* controller)
{
  const float* data = values->GetPointer(0);
  const auto count = static_cast<std::size_t>(values->GetNumberOfValues());
  ErrorStatistics mine;
  mine.add(data, count);
  const auto all = ErrorStatistics::fromArray(sumOverRanks(mine.toArray(), controller));
  ErrorOrderStatistics order(all);
  order.add(data, count);
  order.setArray(sumOverRanks(order.toArray(), controller));
  return order.summary();
}

} // namespace msi

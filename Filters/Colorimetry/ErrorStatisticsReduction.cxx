#include "ErrorStatisticsReduction.h"

#include "ThreadedParts.h"

#include "vtkCommunicator.h"
#include "vtkFloatArray.h"
#include "vtkMultiProcessController.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include "Kernels/Difference/ErrorOrderStatistics.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
// A part of the values for each thread: the statistics are the same for every split.
template <typename Statistics>
Statistics addedInParts(vtkFloatArray* values, const Statistics& empty)
{
  constexpr vtkIdType FewValues = 65536; // for which a state of its own takes longer than it saves
  const float* data = values->GetPointer(0);
  const vtkIdType count = values->GetNumberOfValues();
  const vtkIdType parts = std::clamp<vtkIdType>(
    vtkSMPTools::GetEstimatedNumberOfThreads(), 1, std::max<vtkIdType>(1, count / FewValues));
  std::vector<Statistics> states(static_cast<std::size_t>(parts), empty);
  forParts(parts,
    [&](vtkIdType part)
    {
      const vtkIdType begin = count * part / parts;
      const vtkIdType end = count * (part + 1) / parts;
      states[static_cast<std::size_t>(part)].add(
        data + begin, static_cast<std::size_t>(end - begin));
    });
  for (std::size_t i = 1; i < states.size(); ++i)
  {
    states.front().merge(states[i]);
  }
  return std::move(states.front());
}
}

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
  const ErrorStatistics mine = addedInParts(values, ErrorStatistics());
  const auto all = ErrorStatistics::fromArray(sumOverRanks(mine.toArray(), controller));
  ErrorOrderStatistics order = addedInParts(values, ErrorOrderStatistics(all));
  order.setArray(sumOverRanks(order.toArray(), controller));
  return order.summary();
}

} // namespace msi

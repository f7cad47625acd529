#include "Kernels/Difference/ErrorOrderStatistics.h"

#include "Kernels/Difference/ErrorPass.h"
#include "Kernels/Difference/Percentile.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

using namespace errorpass;

namespace
{
constexpr std::array<double, 3> Percents{ 50.0, 95.0, 100.0 };
}

ErrorOrderStatistics::ErrorOrderStatistics(const ErrorStatistics& firstPass)
  : Summary(emptySummary(firstPass.nonFinite()))
{
  const std::int64_t count = firstPass.count();
  if (count == 0)
  {
    return;
  }
  Summary.count = count;
  Summary.mean = firstPass.mean();
  Summary.standardDeviation = firstPass.standardDeviation();

  for (const double percent : Percents)
  {
    const PercentilePosition position = percentilePosition(count, percent);
    Targets.push_back(locate(firstPass, position.lower));
    Targets.push_back(locate(firstPass, position.upper));
  }
  State.assign(Bins.size() * HalfKeys, 0);
}

ErrorOrderStatistics::Target ErrorOrderStatistics::locate(
  const ErrorStatistics& firstPass, std::int64_t rank)
{
  const std::int64_t* histogram = firstPass.histogram();
  std::uint16_t bin = 0;
  while (histogram[bin] <= rank)
  {
    rank -= histogram[bin++];
  }
  const auto known = std::find(Bins.begin(), Bins.end(), bin);
  const auto slot = static_cast<std::size_t>(known - Bins.begin());
  if (known == Bins.end())
  {
    Bins.push_back(bin);
  }
  return { rank, histogram[bin], slot };
}

void ErrorOrderStatistics::add(const float* values, std::size_t count) noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t bits = bitsOf(values[i]);
    if (!isFinite(bits))
    {
      continue;
    }
    const std::uint32_t key = keyOf(bits);
    for (std::size_t slot = 0; slot < Bins.size(); ++slot)
    {
      if (Bins[slot] == key >> 16)
      {
        ++State[slot * HalfKeys + (key & 0xffffU)];
        break;
      }
    }
  }
}

void ErrorOrderStatistics::merge(const ErrorOrderStatistics& other) noexcept
{
  addTo(State, other.State);
}

void ErrorOrderStatistics::setArray(std::vector<std::int64_t> state)
{
  requireLength(state.size(), State.size(), "ErrorOrderStatistics after this first pass");
  State = std::move(state);
}

double ErrorOrderStatistics::valueAt(const Target& target) const
{
  const std::int64_t* histogram = State.data() + target.slot * HalfKeys;
  std::int64_t total = 0;
  std::uint32_t found = HalfKeys;
  for (std::uint32_t lower = 0; lower < HalfKeys; ++lower)
  {
    total += histogram[lower];
    if (found == HalfKeys && total > target.rankInBin)
    {
      found = lower;
    }
  }
  if (total != target.binCount)
  {
    std::ostringstream message;
    message << "the second pass of the error statistics met " << total
            << " values where the first pass met " << target.binCount
            << "; both passes must run over the same values";
    throw std::logic_error(message.str());
  }
  return valueOfKey((static_cast<std::uint32_t>(Bins[target.slot]) << 16) | found);
}

ErrorSummary ErrorOrderStatistics::summary() const
{
  ErrorSummary result = Summary;
  if (Targets.empty())
  {
    return result;
  }
  std::array<double*, Percents.size()> figures{ &result.median, &result.p95, &result.max };
  for (std::size_t i = 0; i < figures.size(); ++i)
  {
    const PercentilePosition position = percentilePosition(Summary.count, Percents[i]);
    *figures[i] =
      interpolate(valueAt(Targets[2 * i]), valueAt(Targets[2 * i + 1]), position.fraction);
  }
  return result;
}

ErrorSummary summarize(const float* values, std::size_t count)
{
  ErrorStatistics first;
  first.add(values, count);
  ErrorOrderStatistics second(first);
  second.add(values, count);
  return second.summary();
}

} // namespace msi

#include "Kernels/Gap/ReportParts.h"

#include "Kernels/Camera/CameraEffect.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace msi
{

namespace
{
constexpr double LeastPart = 0.03; // of the causes together
constexpr std::size_t EquivalentNamed = 2;
}

const char* nameOf(GapVerdict verdict) noexcept
{
  switch (verdict)
  {
    case GapVerdict::NoGap:
      return "no gap";
    case GapVerdict::Explained:
      return "explained";
    case GapVerdict::PartlyExplained:
      return "partly explained";
    case GapVerdict::Unexplained:
      break;
  }
  return "unexplained";
}

double creditCauses(GapReport& report, std::vector<GapCause> causes)
{
  const auto sumOf = [](const std::vector<GapCause>& some)
  {
    return std::accumulate(some.begin(), some.end(), 0.0,
      [](double sum, const GapCause& cause) { return sum + cause.share; });
  };
  const double all = sumOf(causes);
  const auto first = std::stable_partition(causes.begin(), causes.end(),
    [all](const GapCause& cause) { return cause.share > LeastPart * all; });
  report.uncredited.clear();
  std::transform(first, causes.end(), std::back_inserter(report.uncredited),
    [](const GapCause& cause) { return cause.effect; });
  causes.erase(first, causes.end());
  report.causes = std::move(causes);
  const double share = sumOf(report.causes);
  report.unexplained.share = std::clamp(1.0 - share, 0.0, 1.0);
  return share;
}

void noteUncredited(std::vector<std::string>& notes, const std::vector<std::string>& effects)
{
  if (effects.empty())
  {
    return;
  }
  std::string names;
  for (const std::string& name : effects)
  {
    names += (names.empty() ? "" : ", ") + name;
  }
  notes.push_back("The corrected simulator also has " + names +
    ": with it the readings are predicted better, but it is not believed to be a cause.");
}

std::vector<std::string> cheapestOf(std::vector<Rival> rivals)
{
  std::stable_sort(
    rivals.begin(), rivals.end(), [](const Rival& a, const Rival& b) { return a.cost < b.cost; });
  std::vector<std::string> names;
  for (const Rival& rival : rivals)
  {
    if (names.size() < EquivalentNamed &&
      std::find(names.begin(), names.end(), rival.effect) == names.end())
    {
      names.push_back(rival.effect);
    }
  }
  return names;
}

void recommendCapture(GapReport& report)
{
  const auto ambiguous = std::find_if(report.causes.begin(), report.causes.end(),
    [](const GapCause& cause) { return !cause.equivalent.empty(); });
  if (ambiguous != report.causes.end())
  {
    GapNextCapture next{ separatingCapture(ambiguous->effect), { ambiguous->effect } };
    next.separates.insert(
      next.separates.end(), ambiguous->equivalent.begin(), ambiguous->equivalent.end());
    report.nextCapture = std::move(next);
  }
}

std::string whereIs(const std::vector<GapAxis>& axes)
{
  if (axes.empty())
  {
    return "no axis stands out";
  }
  const GapAxis& axis = axes.front();
  if (axis.worst.empty())
  {
    return axis.axis;
  }
  const std::string& cell = axis.worst.front().cell;
  return cell.rfind(axis.axis, 0) == 0 ? cell : axis.axis + " " + cell;
}

} // namespace msi

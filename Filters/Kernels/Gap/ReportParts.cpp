#include "Kernels/Gap/ReportParts.h"

#include "Kernels/Camera/CameraEffect.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
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

double GapReport::probabilityOf(const std::string& name) const
{
  const auto found = std::find_if(probabilities.begin(), probabilities.end(),
    [&name](const auto& one) { return one.first == name; });
  return found == probabilities.end() ? 0.0 : found->second;
}

void believe(GapReport& report, std::vector<std::pair<std::string, double>> probabilities)
{
  std::stable_sort(probabilities.begin(), probabilities.end(),
    [](const auto& a, const auto& b) { return a.second > b.second; });
  report.probabilities = std::move(probabilities);
  for (GapCause& cause : report.causes)
  {
    cause.probability = report.probabilityOf(cause.effect);
  }
  if (report.verdict == GapVerdict::Explained && report.probabilityOf("unknown") > 0.5)
  {
    report.verdict = GapVerdict::PartlyExplained;
  }
}

void requireKnown(const std::vector<std::string>& without)
{
  for (const std::string& name : without)
  {
    if (findEffect(name) == nullptr)
    {
      throw std::invalid_argument("there is no effect '" + name + "' to leave out");
    }
  }
}

GapVerdict verdictOf(double shrink, bool noiseAlone) noexcept
{
  return noiseAlone || shrink >= Decision::ExplainedShrink ? GapVerdict::Explained
    : shrink >= Decision::PartlyShrink                     ? GapVerdict::PartlyExplained
                                                           : GapVerdict::Unexplained;
}

bool isOfLinearFit(const std::string& effect, const std::string& form)
{
  const EffectDefinition* known = findEffect(effect);
  const EffectForm* found = known == nullptr ? nullptr : findForm(*known, form);
  return found != nullptr && found->has(FormTrait::BesideLine);
}

void creditCauses(GapReport& report, std::vector<GapCause> causes, double leastPerChannel)
{
  const auto sumOf = [](const std::vector<GapCause>& some)
  {
    return std::accumulate(some.begin(), some.end(), 0.0,
      [](double sum, const GapCause& cause) { return sum + cause.share; });
  };
  const double all = sumOf(causes);
  const auto isCause = [all, leastPerChannel](const GapCause& cause)
  {
    return isOfLinearFit(cause.effect, cause.form)
      ? cause.share > Decision::PartlyShrink
      : cause.share > (cause.perChannel ? leastPerChannel : Decision::LeastPart) * all;
  };
  const auto first = std::stable_partition(causes.begin(), causes.end(), isCause);
  report.uncredited.clear();
  for (auto cause = first; cause != causes.end(); ++cause)
  {
    if (!isOfLinearFit(cause->effect, cause->form)) // which has a note of its own
    {
      report.uncredited.push_back(cause->effect);
    }
  }
  causes.erase(first, causes.end());
  report.causes = std::move(causes);
  report.unexplained.share = std::clamp(1.0 - sumOf(report.causes), 0.0, 1.0);
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

void leaveAsItWas(GapFigures& figures)
{
  figures.rmsAfter = figures.rmsBefore;
  figures.shrink = 0.0;
  figures.shrinkInterval = { 0.0, 0.0 };
}

} // namespace msi

#include "Kernels/Gap/Diagnosis/FoundCauses.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/ReportParts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace msi
{

namespace
{
constexpr double MinutesToGetReady = 10.0;

// Of every subset of the positions: fitted anew from where the whole set is, or as it was found on the way.
std::vector<double> subsetShrinksOf(const Observation& data, const FoundSets& found)
{
  const ObservedFit& best = *found.best;
  const std::size_t subsets = std::size_t(1) << best.set.size();
  std::vector<double> shrink(subsets, 0.0);
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    FitPointer fit = subset + 1 == subsets ? found.best : data.reduced(best, subset);
    for (const FitPointer& other : found.visited)
    {
      const bool same = other->set.size() == fit->set.size() &&
        std::is_permutation(other->set.begin(), other->set.end(), fit->set.begin());
      fit = same && other->energy < fit->energy ? other : fit;
    }
    shrink[subset] = std::fmax(shrinkOf(data.energies(*fit)), 0.0);
  }
  return shrink;
}

// The effects of a set beyond those of the best, without the one at a position; nothing where another one is missing.
std::optional<std::vector<std::size_t>> others(const std::vector<GapOption>& options,
  const std::vector<std::size_t>& best, std::size_t position, std::vector<std::size_t> set)
{
  for (std::size_t p = 0; p < best.size(); ++p)
  {
    const auto same = std::find_if(set.begin(), set.end(),
      [&](std::size_t option) { return options[option].sameCause(options[best[p]]); });
    if (same != set.end())
    {
      set.erase(same);
    }
    else if (p != position)
    {
      return std::nullopt;
    }
  }
  return set;
}

// Effects that, in the place of the one at this position, explain the data nearly as well; in that of numbers of single channels
// also those with common numbers that do most of it alone, if the channels' numbers do the rest.
std::vector<std::string> equivalentsAt(
  const Observation& data, const FoundSets& found, std::size_t position)
{
  const std::vector<GapOption>& options = data.options();
  const std::vector<std::size_t>& best = found.best->set;
  const GapOption& own = options[best[position]];
  const double top = *std::max_element(found.score.begin(), found.score.end());
  const double half = 0.5 * (found.nominal->energy + found.best->energy);
  std::vector<Rival> rivals;
  std::set<std::size_t> doMost;
  std::vector<std::pair<std::size_t, double>> beside; // option and score
  for (std::size_t v = 0; v < found.visited.size(); ++v)
  {
    const ObservedFit& fit = *found.visited[v];
    const auto left = others(options, best, position, fit.set);
    if (!left || left->size() != 1 || options[left->front()].effect == own.effect)
    {
      continue;
    }
    const std::size_t other = left->front();
    const bool likely = found.score[v] >= top - Decision::DecisiveOdds;
    if (fit.set.size() == best.size())
    {
      if (likely)
      {
        rivals.push_back({ options[other].effect->name, -found.score[v] });
      }
      if (fit.energy < half)
      {
        doMost.insert(other);
      }
    }
    else if (likely && own.perChannel && !options[other].perChannel)
    {
      beside.emplace_back(other, found.score[v]);
    }
  }
  for (const auto& [option, score] : beside)
  {
    if (doMost.count(option) > 0)
    {
      rivals.push_back({ options[option].effect->name, -score });
    }
  }
  return cheapestOf(std::move(rivals));
}

// Whether a number for each channel is needed: the effect has no form with one for all, or most of what they are is not their mean.
bool differByChannel(const GapOption& option, const std::vector<GapParameter>& numbers)
{
  double common = 0.0;
  double all = 0.0;
  for (const EffectParameter& parameter : findForm(*option.effect, option.form)->parameters)
  {
    double sum = 0.0;
    double count = 0.0;
    for (const GapParameter& number : numbers)
    {
      if (parameter.perChannel && number.name.rfind(parameter.name + "[", 0) == 0)
      {
        const double deviation = (number.value - parameter.neutral) / parameter.typical;
        sum += deviation;
        count += 1.0;
        all += deviation * deviation;
      }
    }
    common += sum * sum / std::fmax(count, 1.0);
  }
  return option.perChannel && (!option.effect->hasCommonForm() || 2.0 * common <= all);
}

// Single effects by what each alone would do.
std::vector<GapCandidate> foundCandidates(
  const Observation& data, const FoundSets& found, std::uint64_t seed)
{
  std::map<std::pair<std::string, std::string>, std::size_t> bestForm;
  for (std::size_t v = 0; v < found.visited.size(); ++v)
  {
    if (found.visited[v]->set.size() == 1)
    {
      const GapOption& option = data.options()[found.visited[v]->set.front()];
      const auto [entry, fresh] =
        bestForm.emplace(std::make_pair(option.effect->name, option.medium), v);
      if (!fresh && found.score[v] > found.score[entry->second])
      {
        entry->second = v;
      }
    }
  }
  std::vector<GapCandidate> candidates;
  for (const auto& [cause, v] : bestForm)
  {
    const GroupEnergies energies = data.energies(*found.visited[v]);
    const GapFigures figures = figuresOf(energies, 1.0, seed);
    candidates.push_back({ cause.first, data.options()[found.visited[v]->set.front()].form,
      cause.second, figures.shrink, figures.shrinkInterval });
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const GapCandidate& a, const GapCandidate& b) { return a.shrink > b.shrink; });
  return candidates;
}

// Causes of a medium beside another of it, a parameter at its bound, and what the set tells.
int standInsOf(const Observation& data, const ObservedFit& fit)
{
  std::set<std::string> media;
  int count = signsOfStandIns(data.options(), fit.set) + (fit.atBound ? 1 : 0);
  for (const std::size_t option : fit.set)
  {
    const std::string& medium = data.options()[option].medium;
    count += !medium.empty() && !media.insert(medium).second ? 1 : 0;
  }
  return count;
}

std::set<std::string> namesOf(const Observation& data, const ObservedFit& fit)
{
  std::set<std::string> names;
  for (const std::size_t option : fit.set)
  {
    names.insert(data.options()[option].effect->name);
  }
  return names;
}

// What gets too little beside the causes to be one is none in explanations that have the large ones.
void leaveOutSmall(std::vector<Explanation>& explanations, const std::set<std::string>& best,
  const std::vector<GapCause>& causes, double shares)
{
  std::set<std::string> credited, large;
  for (const GapCause& cause : causes)
  {
    credited.insert(cause.effect);
    if (cause.share > Decision::LeastPartPerChannel * shares)
    {
      large.insert(cause.effect);
    }
  }
  for (Explanation& one : explanations)
  {
    if (std::includes(one.effects.begin(), one.effects.end(), large.begin(), large.end()))
    {
      for (const std::string& name : best)
      {
        if (credited.count(name) == 0)
        {
          one.effects.erase(name);
        }
      }
    }
  }
}

std::map<std::string, double> chancesOf(const std::vector<Explanation>& explanations)
{
  std::map<std::string, double> effects;
  for (const Explanation& explanation : explanations)
  {
    for (const std::string& name : explanation.effects)
    {
      effects[name] += explanation.probability;
    }
  }
  return effects;
}

// Of the gap's size, what large gains do not take away.
double inexactPart(const Observation& data, const FoundSets& found)
{
  const double inexact = std::fmax(found.inexactEnergy - data.noiseEnergy(), 0.0);
  return std::sqrt(std::fmin(inexact / std::fmax(found.gapEnergy, 1e-300), 1.0));
}
}

std::vector<double> sharesUnderPrecedence(
  const std::vector<double>& shrink, const std::vector<char>& later)
{
  const std::vector<double> plain = shapleyValues(shrink, later.size());
  std::vector<double> share(later.size(), 0.0);
  std::size_t present = 0;
  for (const char turn : { 0, 1 })
  {
    std::vector<std::size_t> players;
    for (std::size_t p = 0; p < later.size(); ++p)
    {
      if (later[p] == turn)
      {
        players.push_back(p);
      }
    }
    std::vector<double> value;
    std::size_t all = present;
    for (std::size_t subset = 0; subset < std::size_t(1) << players.size(); ++subset)
    {
      all = present;
      for (std::size_t p = 0; p < players.size(); ++p)
      {
        all |= (subset >> p & 1U) != 0 ? std::size_t(1) << players[p] : 0;
      }
      value.push_back(shrink[all]);
    }
    const std::vector<double> worth = shapleyValues(value, players.size());
    for (std::size_t p = 0; p < players.size(); ++p)
    {
      const std::size_t player = players[p];
      share[player] =
        turn == 0 ? std::fmax(worth[p], plain[player]) : std::fmin(worth[p], plain[player]);
    }
    present = all;
  }
  return share;
}

std::vector<GapCause> foundCauses(const Observation& data, const FoundSets& found, double shrink)
{
  const ObservedFit& best = *found.best;
  const std::vector<double> reached = subsetShrinksOf(data, found);
  const auto parameters = data.parameters(best);
  std::vector<char> later;
  for (std::size_t p = 0; p < best.set.size(); ++p)
  {
    later.push_back(differByChannel(data.options()[best.set[p]], parameters[p]) ? 1 : 0);
  }
  std::vector<double> share = sharesUnderPrecedence(reached, later);
  double sum = 0.0;
  for (double& one : share)
  {
    one = std::fmax(one, 0.0);
    sum += one;
  }
  std::vector<GapCause> causes;
  for (std::size_t p = 0; p < best.set.size(); ++p)
  {
    const GapOption& option = data.options()[best.set[p]];
    GapCause cause;
    cause.effect = option.effect->name;
    cause.form = option.form;
    cause.medium = option.medium;
    cause.perChannel = option.perChannel;
    cause.share = sum > 0.0 ? shrink * share[p] / sum : 0.0;
    cause.shrink = reached[std::size_t(1) << p];
    cause.equivalent = equivalentsAt(data, found, p);
    cause.parameters = parameters[p];
    causes.push_back(std::move(cause));
  }
  sortCauses(causes);
  return causes;
}

double unknownProbability(double explained, double chanceOfCurve, int standIns)
{
  // Before the data speak as likely as an effect that is in the library, and never less.
  const double chance =
    std::clamp(chanceOfCurve, std::numeric_limits<double>::epsilon(), std::exp(-1.0));
  const double odds = (1.0 - std::clamp(explained, 0.0, 1.0)) / Decision::UnknownRest +
    std::exp(-1.0) * standIns +
    std::exp(-Decision::EffectImprobability - 1.0) / (-chance * std::log(chance));
  return odds / (1.0 + odds);
}

std::vector<Explanation> explanationsOf(const Observation& data, const FoundSets& found)
{
  // Of a set of causes only the likeliest forms count: more forms make no effect likelier.
  const double top = *std::max_element(found.belief.begin(), found.belief.end());
  std::map<std::set<std::string>, Explanation> sets;
  double all = 0.0;
  for (std::size_t v = 0; v < found.visited.size(); ++v)
  {
    const std::set<std::string> names = namesOf(data, *found.visited[v]);
    const double weight = std::exp((found.belief[v] - top) / Decision::Temperature);
    Explanation& explanation = sets[names];
    if (!explanation.fit || weight > explanation.probability)
    {
      all += weight - explanation.probability;
      explanation = { names, found.visited[v], weight };
    }
  }
  std::vector<Explanation> explanations;
  for (auto& [names, explanation] : sets)
  {
    explanation.probability /= all;
    explanations.push_back(std::move(explanation));
  }
  std::stable_sort(explanations.begin(), explanations.end(),
    [](const Explanation& a, const Explanation& b) { return a.probability > b.probability; });
  return explanations;
}

std::vector<std::string> disputed(
  const std::vector<Explanation>& explanations, const std::set<std::string>& inQuestion)
{
  std::vector<Rival> rivals;
  for (const auto& [name, chance] : chancesOf(explanations))
  {
    if (inQuestion.count(name) > 0)
    {
      rivals.push_back({ name, std::fabs(chance - 0.5) });
    }
  }
  return cheapestOf(std::move(rivals));
}

std::set<std::string> inBoth(const std::set<std::string>& a, const std::set<std::string>& b)
{
  std::set<std::string> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(both, both.end()));
  return both;
}

std::set<std::string> inQuestion(const std::vector<GapCause>& causes)
{
  std::set<std::string> effects;
  for (const GapCause& cause : causes)
  {
    effects.insert(cause.effect);
    effects.insert(cause.equivalent.begin(), cause.equivalent.end());
  }
  return effects;
}

void sortByWorth(std::vector<GapNextCapture>& captures)
{
  // In single precision, so that rounding does not order what is equal.
  const auto rate = [](const GapNextCapture& one)
  { return static_cast<float>(*one.expectedBits / (*one.minutes + MinutesToGetReady)); };
  std::stable_sort(captures.begin(), captures.end(),
    [&rate](const GapNextCapture& a, const GapNextCapture& b) { return rate(a) > rate(b); });
}

std::vector<GapNextCapture> separatingCaptures(
  const std::vector<Explanation>& explanations, const std::set<std::string>& inQuestion)
{
  std::map<std::pair<std::string, double>, std::set<std::string>> shown; // by name and minutes
  for (const std::string& name : inQuestion)
  {
    const CaptureKind& kind = requireEffect(name).separatingCapture;
    shown[{ kind.name, kind.minutes }].insert(name);
  }
  const std::vector<std::string> separates = disputed(explanations, inQuestion);
  std::vector<GapNextCapture> captures;
  for (const auto& [capture, effects] : shown)
  {
    std::map<std::set<std::string>, double> chance; // of the effects that it would show
    for (const Explanation& one : explanations)
    {
      chance[inBoth(one.effects, effects)] += one.probability;
    }
    double bits = 0.0;
    for (const auto& [there, probability] : chance)
    {
      bits -= probability > 0.0 ? probability * std::log2(probability) : 0.0;
    }
    if (bits >= LeastBits)
    {
      captures.push_back({ capture.first, separates, bits, capture.second });
    }
  }
  sortByWorth(captures);
  return captures;
}

std::vector<std::pair<std::string, double>> effectProbabilities(
  const std::vector<Explanation>& explanations, bool gap, double none)
{
  double all = none;
  for (const Explanation& explanation : explanations)
  {
    all += explanation.effects.empty() ? (1.0 - none) * explanation.probability : 0.0;
  }
  std::vector<std::pair<std::string, double>> probabilities{ { gap ? "unknown" : "nothing", all },
    { gap ? "nothing" : "unknown", 0.0 } };
  for (const auto& [name, chance] : chancesOf(explanations))
  {
    probabilities.emplace_back(name, (1.0 - none) * chance);
  }
  return probabilities;
}

std::vector<Explanation> conclude(GapReport& report, const Observation& data,
  const FoundSets& found, const Evidence& evidence, std::uint64_t seed)
{
  std::vector<Explanation> explanations = explanationsOf(data, found);
  if (evidence.credited > 0.0)
  {
    creditCauses(report, foundCauses(data, found, evidence.credited), inexactPart(data, found));
    leaveOutSmall(explanations, namesOf(data, *found.best), report.causes, evidence.credited);
    report.verdict = !report.unconfirmed ? verdictOf(evidence.explained)
      : report.causes.empty()            ? GapVerdict::Unexplained
                                         : GapVerdict::PartlyExplained;
    report.unexplained = remainderOf(report.unexplained.share, evidence.rest);
  }
  else
  {
    report.verdict = evidence.gap ? verdictOf(evidence.explained) : GapVerdict::NoGap;
    report.unexplained = remainderOf(evidence.gap ? 1.0 : 0.0, report.where);
    report.gap.rmsAfter = report.gap.rmsBefore;
    report.gap.shrink = 0.0;
    report.gap.shrinkInterval = { 0.0, 0.0 };
  }
  report.candidates = foundCandidates(data, found, seed);
  const bool gap = report.verdict != GapVerdict::NoGap;
  const double confirmed = evidence.explained -
    evidence.takenForNoise * std::fmax(evidence.explained - Decision::Unconfirmed, 0.0);
  const bool ofChannels = std::any_of(report.causes.begin(), report.causes.end(),
    [](const GapCause& cause) { return cause.perChannel; });
  const double none = gap
    ? unknownProbability(
        confirmed, ofChannels ? found.best->chanceOfCurve : 1.0, standInsOf(data, *found.best))
    : 1.0 / (1.0 + std::fmin(evidence.noticed, 1.0));
  believe(report, effectProbabilities(explanations, gap, none));
  return explanations;
}

} // namespace msi

#include "Figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <sstream>

namespace withheld
{

namespace
{
template <typename List, typename Value>
bool contains(const List& list, const Value& value)
{
  return std::find(list.begin(), list.end(), value) != list.end();
}

bool quiet(const ScoredCase& one)
{
  return one.verdict == "no gap" && one.causes.empty();
}

bool rightAxis(const ScoredCase& one)
{
  return contains(one.axes, one.axis);
}

bool isUnknown(const ScoredCase& one)
{
  return one.set == "stranger" || one.set == "removed";
}

// Every planted effect may be found once, every cause may find one.
struct Matches
{
  int found = 0;
  int named = 0;
  int planted = 0;
};

Matches matchesOf(const ScoredCase& one, bool withClass)
{
  Matches matches;
  matches.planted = static_cast<int>(one.planted.size());
  std::vector<std::string> open = one.planted;
  std::vector<const NamedCause*> unmatched;
  for (const NamedCause& cause : one.causes)
  {
    if (cause.share < NamedShare)
    {
      continue;
    }
    ++matches.named;
    const auto exact = std::find(open.begin(), open.end(), cause.effect);
    if (exact != open.end())
    {
      open.erase(exact);
      ++matches.found;
    }
    else
    {
      unmatched.push_back(&cause);
    }
  }
  for (const NamedCause* cause : unmatched)
  {
    const auto alike = std::find_if(open.begin(), open.end(),
      [cause](const std::string& effect) { return contains(cause->equivalent, effect); });
    if (withClass && alike != open.end())
    {
      open.erase(alike);
      ++matches.found;
    }
  }
  return matches;
}

class Figures
{
public:
  explicit Figures(const std::vector<ScoredCase>& cases)
    : Cases(cases)
  {
  }

  void part(const std::string& name, const std::string& set,
    const std::function<bool(const ScoredCase&)>& good)
  {
    double hits = 0.0;
    const auto members = of(set);
    for (const ScoredCase* one : members)
    {
      hits += good(*one) ? 1.0 : 0.0;
    }
    add(name, hits, members.size());
  }
  void harmonic(const std::string& name, const std::string& set, bool withClass)
  {
    Matches sum;
    const auto members = of(set);
    for (const ScoredCase* one : members)
    {
      const Matches matches = matchesOf(*one, withClass);
      sum.found += matches.found;
      sum.named += matches.named;
      sum.planted += matches.planted;
    }
    const double value = 2.0 * sum.found / std::max(sum.named + sum.planted, 1);
    add(name, value * static_cast<double>(members.size()), members.size());
  }
  void medianShrink()
  {
    std::vector<double> ratio;
    for (const ScoredCase* one : of("single"))
    {
      if (!contains(one->planted, std::string("excess_noise")) && one->bestShrink > 0.0)
      {
        ratio.push_back(one->shrink / one->bestShrink);
      }
    }
    if (!ratio.empty())
    {
      std::sort(ratio.begin(), ratio.end());
      const double median = ratio[ratio.size() / 2];
      add("single: median shrink over the best possible",
        median * static_cast<double>(ratio.size()), ratio.size());
    }
  }
  // Of each effect's probability over all cases that tell one. A named effect is right where it was planted, "unknown"
  // where something was that the library does not have, "nothing" where nothing was.
  void calibration()
  {
    constexpr int Bins = 10;
    double squares = 0.0;
    std::array<double, Bins> told{};
    std::array<double, Bins> came{};
    double answers = 0.0;
    double cases = 0.0;
    double rash = 0.0;
    for (const ScoredCase& one : Cases)
    {
      if (one.probabilities.empty())
      {
        continue;
      }
      std::set<std::string> truth(one.planted.begin(), one.planted.end());
      if (isUnknown(one))
      {
        truth = { "unknown" };
      }
      else if (truth.empty())
      {
        truth = { "nothing" };
      }
      std::map<std::string, double> every = one.probabilities;
      for (const std::string& name : truth)
      {
        every.emplace(name, 0.0); // not told
      }
      for (const auto& [name, probability] : every)
      {
        const double right = truth.count(name) > 0 ? 1.0 : 0.0;
        const auto bin =
          static_cast<std::size_t>(std::clamp(static_cast<int>(Bins * probability), 0, Bins - 1));
        squares += (probability - right) * (probability - right);
        told[bin] += probability;
        came[bin] += right;
        answers += 1.0;
      }
      cases += 1.0;
      if (!one.causes.empty() && truth.count(one.causes.front().effect) == 0)
      {
        const auto first = one.probabilities.find(one.causes.front().effect);
        rash += first != one.probabilities.end() && first->second > 0.7 ? 1.0 : 0.0;
      }
    }
    double error = 0.0;
    for (std::size_t bin = 0; bin < Bins; ++bin)
    {
      error += std::fabs(told[bin] - came[bin]);
    }
    add("probability: calibration error", error, static_cast<std::size_t>(answers));
    add("probability: Brier score, sum of a case", squares, static_cast<std::size_t>(cases));
    add("probability: above .7 on a wrong first cause", rash, static_cast<std::size_t>(cases));
  }
  std::vector<Figure> take() { return std::move(List); }

private:
  std::vector<const ScoredCase*> of(const std::string& set) const
  {
    std::vector<const ScoredCase*> members;
    for (const ScoredCase& one : Cases)
    {
      if (one.set == set || (set == "unknown" && isUnknown(one)) ||
        (set == "located" && one.set == "single" &&
          !contains(one.planted, std::string("excess_noise"))))
      {
        members.push_back(&one);
      }
    }
    return members;
  }
  void add(const std::string& name, double sum, std::size_t count)
  {
    if (count > 0)
    {
      List.push_back({ name, sum / static_cast<double>(count), static_cast<int>(count) });
    }
  }

  const std::vector<ScoredCase>& Cases;
  std::vector<Figure> List;
};

std::string describe(const ScoredCase& one)
{
  std::ostringstream line;
  line.precision(2);
  line << one.name << " [" << one.set << "]";
  for (std::size_t e = 0; e < one.planted.size(); ++e)
  {
    line << (e > 0 ? " + " : " ") << one.planted[e] << " (" << one.kinds[e] << ')';
  }
  line << " -> " << one.verdict << ", shrink " << one.shrink << " of " << one.bestShrink
       << ", axis " << one.axis << ';';
  for (const NamedCause& cause : one.causes)
  {
    line << ' ' << cause.effect << ' ' << cause.form << ' ' << cause.share;
    for (const std::string& other : cause.equivalent)
    {
      line << " =" << other;
    }
    line << ';';
  }
  return line.str();
}
}

bool firstIs(const ScoredCase& one, const std::string& effect, bool withClass)
{
  return !one.causes.empty() &&
    (one.causes.front().effect == effect ||
      (withClass && contains(one.causes.front().equivalent, effect)));
}

bool unknownSaid(const ScoredCase& one, const std::vector<ScoredCase>& all, bool withClass)
{
  std::vector<std::string> alike;
  const auto twin = std::find_if(
    all.begin(), all.end(), [&one](const ScoredCase& other) { return other.name == one.twin; });
  if (withClass && twin != all.end() && firstIs(*twin, one.planted.front(), true))
  {
    alike = twin->causes.front().equivalent;
    alike.push_back(twin->causes.front().effect);
  }
  bool accused = false;
  bool explained = false;
  for (const NamedCause& cause : one.causes)
  {
    const bool wrong = !contains(alike, cause.effect);
    const auto belief = one.probabilities.find(cause.effect);
    const bool believed = belief == one.probabilities.end() || belief->second >= AccusedProbability;
    accused = accused || (wrong && believed && cause.share >= AccusedShare);
    explained = explained || (!wrong && cause.share >= AccusedShare);
  }
  const bool unknown = one.verdict == "partly explained" || one.verdict == "unexplained";
  return !accused && (unknown || explained);
}

std::vector<Figure> figuresOf(const std::vector<ScoredCase>& cases)
{
  Figures figures(cases);
  const auto exact = [](const ScoredCase& one) { return firstIs(one, one.planted.front(), false); };
  const auto alike = [](const ScoredCase& one) { return firstIs(one, one.planted.front(), true); };
  const auto unknown = [&cases](bool withClass)
  {
    return [&cases, withClass](const ScoredCase& one)
    { return unknownSaid(one, cases, withClass); };
  };
  const auto spared = [](const ScoredCase& one)
  { return one.causes.empty() || one.causes.front().share < AccusedShare; };
  figures.part("single: first cause exact", "single", exact);
  figures.part("single: exact, no equivalent", "single",
    [&exact](const ScoredCase& one)
    { return exact(one) && one.causes.front().equivalent.empty(); });
  figures.part("single: within its class", "single", alike);
  figures.part("single: right axis", "located", rightAxis);
  figures.medianShrink();
  figures.harmonic("several: F1", "several", true);
  figures.harmonic("several: F1, exact names only", "several", false);
  figures.part("clean: quiet", "clean", quiet);
  figures.part("clean: no cause given half", "clean", spared);
  figures.part("unknown: said, no wrong cause", "unknown", unknown(true));
  figures.part("unknown: stranger", "stranger", unknown(true));
  figures.part("unknown: removed", "removed", unknown(true));
  figures.part("unknown: removed, no class granted", "removed", unknown(false));
  figures.part("nominal: first cause exact", "nominal", exact);
  figures.part("nominal: within its class", "nominal", alike);
  figures.harmonic("nominal several: F1", "nominal several", true);
  figures.part("third: within its class", "third", alike);
  figures.part("few: within its class", "few", alike);
  figures.calibration();
  return figures.take();
}

std::vector<std::string> failuresOf(const std::vector<ScoredCase>& cases)
{
  std::vector<std::string> lines;
  for (const ScoredCase& one : cases)
  {
    std::string what;
    if (isUnknown(one))
    {
      what = unknownSaid(one, cases, true) ? "" : "WRONG ";
    }
    else if (one.planted.empty())
    {
      what = quiet(one) ? "" : "NOISY ";
    }
    else if (one.planted.size() > 1)
    {
      const Matches matches = matchesOf(one, true);
      what = matches.found < matches.planted || matches.found < matches.named ? "MIXED " : "";
    }
    else
    {
      const bool located = rightAxis(one) || one.planted.front() == "excess_noise";
      what = firstIs(one, one.planted.front(), false) ? ""
        : firstIs(one, one.planted.front(), true)     ? "CLASS "
                                                      : "WRONG ";
      what += located || one.set != "single" ? "" : "AXIS ";
    }
    if (!what.empty())
    {
      lines.push_back(what + describe(one));
    }
  }
  return lines;
}

} // namespace withheld

#include "Figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
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

  void part(const std::string& name, double bar, const std::string& set,
    const std::function<bool(const ScoredCase&)>& good)
  {
    double hits = 0.0;
    const auto members = of(set);
    for (const ScoredCase* one : members)
    {
      hits += good(*one) ? 1.0 : 0.0;
    }
    add(name, hits, members.size(), bar);
  }
  void harmonic(const std::string& name, double bar, const std::string& set, bool withClass)
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
    add(name, value * static_cast<double>(members.size()), members.size(), bar);
  }
  void medianShrink(double bar)
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
        median * static_cast<double>(ratio.size()), ratio.size(), bar);
    }
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
  void add(const std::string& name, double sum, std::size_t count, double bar)
  {
    if (count > 0)
    {
      List.push_back({ name, sum / static_cast<double>(count), bar, static_cast<int>(count) });
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
    accused = accused || (wrong && cause.share >= AccusedShare);
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
  figures.part("single: first cause exact", 0.92, "single", exact);
  figures.part("single: within its class", 0.98, "single", alike);
  figures.part("single: right axis", 0.92, "located", rightAxis);
  figures.medianShrink(0.95);
  figures.harmonic("several: F1", 0.92, "several", true);
  figures.harmonic("several: F1, exact names only", 0.0, "several", false);
  figures.part("clean: quiet", 0.97, "clean", quiet);
  figures.part("unknown: said, no wrong cause", 0.90, "unknown", unknown(true));
  figures.part("unknown: stranger", 0.0, "stranger", unknown(true));
  figures.part("unknown: removed", 0.0, "removed", unknown(true));
  figures.part("unknown: removed, no class granted", 0.0, "removed", unknown(false));
  figures.part("nominal: first cause exact", 0.0, "nominal", exact);
  figures.part("nominal: within its class", 0.95, "nominal", alike);
  figures.harmonic("nominal several: F1", 0.88, "nominal several", true);
  figures.part("third: within its class", 0.92, "third", alike);
  figures.part("few: within its class", 0.88, "few", alike);
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

#include "EvidenceEngine.h"

#include "SetEvidence.h"

#include "Kernels/Gap/EffectExtension.h"
#include "Kernels/Gap/Field/FieldGap.h"
#include "Kernels/Gap/GapAxes.h"
#include "Kernels/Gap/GapEvidence.h"
#include "Kernels/Gap/GapNoise.h"
#include "Kernels/Gap/Shapley.h"
#include "Kernels/Gap/Shrink.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace withheld
{

namespace
{
using namespace msi;

constexpr int Tried = 10;          // effects fitted beside a set
constexpr std::size_t Largest = 4; // effects of a set
constexpr double Temper = 8.0; // a nat of evidence over what it is worth: forms are approximations
constexpr double Worth = 3.0;  // nats that another effect must bring
constexpr double Named = 0.03; // of the gap

// A set of causes, each with its medium, in any order.
using Causes = std::set<std::pair<std::string, std::string>>;

struct Hypothesis
{
  EffectFit fit;
  double log = 0.0;
};

class Search
{
public:
  Search(const EffectFitter& fitter, std::vector<EffectChoice> choices)
    : Fitter(fitter)
    , Choices(std::move(choices))
    , Evidence(fitter)
  {
    std::set<std::pair<std::string, std::string>> causes;
    for (const EffectChoice& choice : Choices)
    {
      causes.insert({ choice.effect->name, choice.medium });
      ++Forms[{ choice.effect->name, choice.medium }];
    }
    Effects = static_cast<double>(causes.size());
  }

  Hypothesis run()
  {
    Hypothesis best = judged(Fitter.nominal());
    // One effect more, then others in the place of each.
    for (bool better = true; better;)
    {
      better = false;
      for (Hypothesis& larger : extended(best.fit))
      {
        if (best.fit.set.size() < Largest && larger.log > best.log + Worth)
        {
          best = std::move(larger);
          better = true;
        }
      }
      for (std::size_t e = 0; e < best.fit.set.size(); ++e)
      {
        EffectSet rest = best.fit.set;
        rest.remove(e);
        const Hypothesis smaller = judged(Fitter.fit(rest, SearchFit));
        std::vector<Hypothesis> rivals = extended(smaller.fit);
        rivals.push_back(smaller);
        for (Hypothesis& rival : rivals)
        {
          const bool plainer = rival.fit.set.size() < best.fit.set.size();
          if (rival.log > best.log + (plainer ? -Worth : 0.1))
          {
            best = std::move(rival);
            better = true;
          }
        }
        if (better)
        {
          break;
        }
      }
    }
    best.fit = Fitter.fit(best.fit.set, FinalFit);
    return best;
  }

  // Of each cause over all sets that were looked at.
  std::map<std::string, double> probabilities() const
  {
    double highest = -1e300;
    for (const auto& one : Visited)
    {
      highest = std::max(highest, one.second);
    }
    double sum = 0.0;
    std::map<std::string, double> of;
    for (const auto& [causes, log] : Visited)
    {
      const double weight = std::exp((log - highest) / Temper);
      sum += weight;
      for (const auto& cause : causes)
      {
        of[cause.first] += weight;
      }
      if (causes.empty())
      {
        of["nothing"] += weight;
      }
    }
    for (auto& one : of)
    {
      one.second = std::min(one.second / sum, 1.0);
    }
    return of;
  }

private:
  Hypothesis judged(EffectFit fit)
  {
    Hypothesis made{ std::move(fit), 0.0 };
    made.log = Evidence.logOf(made.fit);
    Causes causes;
    for (const EffectChoice& choice : made.fit.set.choices)
    {
      causes.insert({ choice.effect->name, choice.medium });
      made.log -= std::log(Effects * Forms.at({ choice.effect->name, choice.medium }));
    }
    const auto [place, fresh] = Visited.emplace(causes, made.log);
    place->second = fresh ? made.log : std::max(place->second, made.log);
    return made;
  }
  std::vector<Hypothesis> extended(const EffectFit& from)
  {
    std::vector<Hypothesis> list;
    for (EffectFit& fit :
      extendFit(Fitter, from, screenEffects(Fitter, from, Choices, 2.0 * from.dispersion), Tried))
    {
      list.push_back(judged(std::move(fit)));
    }
    return list;
  }

  const EffectFitter& Fitter;
  std::vector<EffectChoice> Choices;
  SetEvidence Evidence;
  std::map<std::pair<std::string, std::string>, double> Forms;
  double Effects = 0.0;
  std::map<Causes, double> Visited;
};

std::vector<double> sharesOf(const EffectFitter& fitter, const EffectFit& best)
{
  const std::size_t count = best.set.size();
  std::vector<double> value(std::size_t(1) << count, 0.0);
  for (std::size_t subset = 1; subset < value.size(); ++subset)
  {
    EffectSet set;
    for (std::size_t e = 0; e < count; ++e)
    {
      if ((subset >> e) % 2 == 1)
      {
        set.add(best.set, e);
      }
    }
    value[subset] = subset + 1 == value.size() ? shrinkOf(fitter, best)
                                               : shrinkOf(fitter, fitter.fit(set, SearchFit));
  }
  return shapleyValues(value, count);
}
}

Answer diagnoseByEvidence(const CaseInput& input, const std::vector<std::string>& without)
{
  GapOptions options;
  options.without = without;
  if (!input.capture)
  {
    return { diagnoseField(input.pair(), options)->report, {} };
  }
  GapData data = prepareGapData(*input.capture, options);
  const NoiseFinding noise = findNoise(data, input.capture->noise);
  if (noise.unknown)
  {
    setUnknownNoise(data);
  }
  else
  {
    data.variance = readingVariance(data, noise.reading);
  }
  data.variance += integrationVariance(data, input.capture->wavelengths);
  setWeights(data);

  Answer answer;
  GapReport& report = answer.report;
  const Eigen::MatrixXd before = measuredOnly(data, data.observed - data.simulated);
  const EffectFitter fitter(data, data.usable, options.seed);
  Search search(fitter, choicesFor(data.scene, without));
  const Hypothesis best = search.run();
  for (const auto& one : search.probabilities())
  {
    answer.probabilities.push_back(one);
  }
  const Eigen::MatrixXd after = measuredOnly(data, best.fit.heldOut);
  report.gap = figuresOf(data, energiesOf(data, before, after), options.seed);
  const AxisShares where = shareOverAxes(data, before, true);
  report.where = where.axes;
  const std::vector<double> shares = sharesOf(fitter, best.fit);
  report.unexplained.share = 1.0;
  for (std::size_t e = 0; e < shares.size(); ++e)
  {
    const EffectChoice& choice = best.fit.set.choices[e];
    if (shares[e] >= Named)
    {
      GapCause cause;
      cause.effect = choice.effect->name;
      cause.form = choice.form->name;
      cause.medium = choice.medium;
      cause.share = shares[e];
      report.causes.push_back(std::move(cause));
      report.unexplained.share -= shares[e];
    }
  }
  std::stable_sort(report.causes.begin(), report.causes.end(),
    [](const GapCause& a, const GapCause& b) { return a.share > b.share; });
  const double shrink = report.gap.shrink;
  if (report.causes.empty())
  {
    report.verdict = predictable(data, before, where) ? GapVerdict::Unexplained : GapVerdict::NoGap;
  }
  else
  {
    report.verdict = shrink >= 0.85 ? GapVerdict::Explained
      : shrink >= 0.25              ? GapVerdict::PartlyExplained
                                    : GapVerdict::Unexplained;
  }
  return answer;
}

} // namespace withheld

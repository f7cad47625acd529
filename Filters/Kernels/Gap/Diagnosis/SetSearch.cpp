#include "Kernels/Gap/Diagnosis/SetSearch.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace msi
{

namespace
{
// Whether every medium that its effect could have been blamed on has it.
bool isEverywhere(const GapOption& option, const std::vector<GapOption>& options,
  const std::vector<std::size_t>& set)
{
  return !option.medium.empty() &&
    std::all_of(options.begin(), options.end(),
      [&](const GapOption& other)
      {
        return other.effect != option.effect ||
          std::any_of(set.begin(), set.end(),
            [&](std::size_t mine) { return options[mine].sameCause(other); });
      });
}

bool isOfOnlyMedium(const GapOption& option, const std::vector<GapOption>& options)
{
  return std::all_of(options.begin(), options.end(),
    [&](const GapOption& other) { return other.medium.empty() || other.medium == option.medium; });
}

constexpr int MostRounds = 4;
constexpr double MuchLess = 0.5;        // energy
constexpr std::ptrdiff_t MostForms = 3; // of a cause, fitted in full in the place of one effect

class SetSearch
{
public:
  SetSearch(const Observation& data, const SetSearchLimits& limits,
    const std::function<bool()>& stop, double inexact)
    : Data(data)
    , Limits(limits)
    , Stop(stop)
    , Nominal(data.nominal())
    , Inexact(inexact)
    , Score(data, *Nominal, Decision::DiscrepancyNumbers, inexact)
  {
    Visited.push_back(Nominal);
  }

  FoundSets run()
  {
    grow();
    for (int round = 0; round < MostRounds && Limits.exchange && !Stop(); ++round)
    {
      const FitPointer before = best();
      if (before->set.empty())
      {
        break;
      }
      revise(*before);
      if (best() == before)
      {
        break;
      }
    }
    FoundSets found{ Nominal, best(), Visited, {}, {}, Score.gapEnergy(), Inexact };
    Criterion belief(Data, *Nominal, Decision::BeliefNumbers, Inexact);
    for (const FitPointer& fit : Visited)
    {
      belief.refer(fit->energy, fit->coherence);
    }
    for (const FitPointer& fit : Visited)
    {
      found.score.push_back(Score(*fit));
      found.belief.push_back(belief(*fit));
    }
    return found;
  }

private:
  FitPointer best() const
  {
    return *std::max_element(Visited.begin(), Visited.end(),
      [this](const FitPointer& a, const FitPointer& b) { return Score(*a) < Score(*b); });
  }

  FitPointer consider(FitPointer fit)
  {
    Score.refer(fit->energy, fit->coherence);
    Visited.push_back(fit);
    return fit;
  }

  // The likeliest options beside those of `from`, at most so many forms of a cause.
  std::vector<GapPreview> promising(const ObservedFit& from, std::size_t most) const
  {
    std::vector<GapPreview> all = Data.previews(from);
    // Judged as if the best of them were the whole truth.
    Criterion hopeful = Score;
    for (const GapPreview& preview : all)
    {
      hopeful.refer(preview.fit.energy, preview.fit.coherence);
    }
    std::vector<std::pair<double, std::size_t>> ranked; // score and number
    for (std::size_t n = 0; n < all.size(); ++n)
    {
      ranked.emplace_back(hopeful(all[n].fit), n);
    }
    std::stable_sort(
      ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<GapPreview> chosen;
    for (const auto& [score, number] : ranked)
    {
      const GapPreview& preview = all[number];
      const auto alike = std::count_if(chosen.begin(), chosen.end(),
        [&](const GapPreview& other)
        { return Data.options()[other.option].sameCause(Data.options()[preview.option]); });
      if (chosen.size() < most && alike < MostForms)
      {
        chosen.push_back(preview);
      }
    }
    // One linear step may leave so much that its many numbers seem not worth it.
    const auto lessLeft = [](const GapPreview& a, const GapPreview& b)
    { return a.fit.energy < b.fit.energy; };
    const auto least = std::min_element(all.begin(), all.end(), lessLeft);
    const auto known = std::min_element(chosen.begin(), chosen.end(), lessLeft);
    if (least != all.end() && least->fit.energy < MuchLess * known->fit.energy)
    {
      chosen.push_back(*least);
    }
    return chosen;
  }

  std::vector<FitPointer> extend(const ObservedFit& from, std::size_t most)
  {
    std::vector<FitPointer> fits;
    for (const GapPreview& preview : promising(from, most))
    {
      std::vector<std::size_t> set = preview.fit.set;
      std::sort(set.begin(), set.end());
      if (Tried.insert(set).second && !Stop())
      {
        fits.push_back(consider(Data.extended(from, preview)));
      }
    }
    return fits;
  }

  bool sameCauses(const ObservedFit& a, const ObservedFit& b) const
  {
    const std::vector<GapOption>& options = Data.options();
    return a.set.size() == b.set.size() &&
      std::all_of(a.set.begin(), a.set.end(),
        [&](std::size_t mine)
        {
          return std::any_of(b.set.begin(), b.set.end(),
            [&](std::size_t other) { return options[mine].sameCause(options[other]); });
        });
  }

  void grow()
  {
    std::vector<FitPointer> beam{ Nominal };
    for (int size = 1; size <= Limits.maximumEffects && !Stop(); ++size)
    {
      std::vector<FitPointer> grown;
      for (const FitPointer& from : beam)
      {
        const std::vector<FitPointer> more = extend(*from, Limits.optionsFitted);
        grown.insert(grown.end(), more.begin(), more.end());
      }
      std::stable_sort(grown.begin(), grown.end(),
        [this](const FitPointer& a, const FitPointer& b) { return Score(*a) > Score(*b); });
      beam.clear();
      for (const FitPointer& fit : grown)
      {
        const bool known = std::any_of(beam.begin(), beam.end(),
          [&](const FitPointer& other) { return sameCauses(*fit, *other); });
        if (!known && beam.size() < Limits.beamWidth)
        {
          beam.push_back(fit);
        }
      }
      // Two may undo one another: neither says so alone.
      if (beam.empty() ||
        (size > 1 && Score(*beam.front()) < Score(*best()) - Decision::DecisiveOdds))
      {
        break;
      }
    }
  }

  // Fewer effects, others, and other forms of them.
  void revise(const ObservedFit& fit)
  {
    const std::size_t all = (std::size_t(1) << fit.set.size()) - 1;
    for (std::size_t first = 0; first < fit.set.size(); ++first)
    {
      const std::size_t rest = all & ~(std::size_t(1) << first);
      extend(*consider(Data.reduced(fit, rest)), Limits.optionsFitted);
      for (std::size_t second = first + 1; second < fit.set.size() && fit.set.size() > 2; ++second)
      {
        if (!Stop())
        {
          extend(*consider(Data.reduced(fit, rest & ~(std::size_t(1) << second))), 4);
        }
      }
    }
  }

  const Observation& Data;
  SetSearchLimits Limits;
  const std::function<bool()>& Stop;
  FitPointer Nominal;
  double Inexact;
  Criterion Score;
  std::vector<FitPointer> Visited;
  std::set<std::vector<std::size_t>> Tried;
};
}

int signsOfStandIns(const std::vector<GapOption>& options, const std::vector<std::size_t>& set)
{
  int signs = 0;
  for (const std::size_t number : set)
  {
    signs +=
      (options[number].inDisguise ? 1 : 0) + (isEverywhere(options[number], options, set) ? 1 : 0);
  }
  return signs;
}

Eigen::ArrayXd energiesBesideGain(const Eigen::ArrayXd& response, const Eigen::ArrayXd& product,
  const Eigen::ArrayXd& gap, bool ofChannels)
{
  const auto large = [](double square, double both)
  {
    const double gain = both / std::fmax(square, 1e-30);
    const double beyond = std::fmax(std::fabs(gain) / Decision::SmallPart, 1.0);
    return gain * (1.0 - 1.0 / (beyond * beyond));
  };
  const Eigen::ArrayXd gain = ofChannels
    ? Eigen::ArrayXd(response.binaryExpr(product, large))
    : Eigen::ArrayXd::Constant(gap.size(), large(response.sum(), product.sum()));
  return gap - gain * (2.0 * product - gain * response);
}

double independentNumbers(double numbers, Eigen::Index groups, Eigen::Index channelNumbers)
{
  return std::fmax(std::fmin(static_cast<double>(groups), numbers),
    Decision::DiscrepancyPerChannel * static_cast<double>(channelNumbers));
}

Criterion::Criterion(
  const Observation& data, const ObservedFit& nominal, double numbers, double inexact)
  : Data(data)
  , Gap(std::fmax(nominal.energy - data.noiseEnergy(), 0.0))
  , Noise(std::fmin(data.noiseEnergy(), nominal.energy))
  // Above zero, so that two equal data sets give numbers, too.
  , Floor(std::fmax(Decision::FormPart * std::fmin(std::fmax(inexact - Noise, 0.0), Gap),
      std::numeric_limits<double>::epsilon() * std::fmax(data.noiseEnergy(), 1.0)))
  , Discrepancy(independentNumbers(numbers, data.energies(nominal).rows(), data.channelNumbers()))
  , Reference(std::numeric_limits<double>::infinity())
{
  refer(nominal.energy, nominal.coherence);
}

void Criterion::refer(double energy, double coherence)
{
  if (!(energy < Reference))
  {
    return;
  }
  Reference = energy;
  const double noise = std::fmin(Noise, Reference) / std::fmax(Data.elements(), 1.0);
  const double left = std::fmax(Reference - Noise, 0.0) + Floor;
  Dispersion = coherence * noise + left / Discrepancy;
  Numbers = (Reference + Floor) / Dispersion;
}

double Criterion::operator()(const ObservedFit& fit) const
{
  if (!std::isfinite(fit.energy))
  {
    return -std::numeric_limits<double>::infinity();
  }
  const double likelihood = -0.5 * Numbers * std::log((fit.energy + Floor) / (Reference + Floor));
  return likelihood - occam(fit) - improbability(fit.set) - (fit.atBound ? Decision::StandIn : 0.0);
}

double Criterion::occam(const ObservedFit& fit) const
{
  return fit.prior.gain(fit.information / Dispersion) + fit.surprise;
}

double Criterion::improbability(const std::vector<std::size_t>& set) const
{
  const std::vector<GapOption>& options = Data.options();
  double sum = 0.0;
  for (const std::size_t number : set)
  {
    const GapOption& option = options[number];
    sum += option.improbability + (option.inDisguise ? Decision::StandIn : 0.0);
    if (isEverywhere(option, options, set))
    {
      // That the only medium has it is no coincidence of several.
      sum += isOfOnlyMedium(option, options) ? Decision::FormImprobability : Decision::StandIn;
    }
  }
  return sum;
}

FoundSets searchSets(
  const Observation& data, const SetSearchLimits& limits, const std::function<bool()>& stop)
{
  const double inexact = data.inexactEnergy(false);
  FoundSets found = SetSearch(data, limits, stop, inexact).run();
  const double besideChannels = data.inexactEnergy(true);
  const bool hasGains = std::any_of(found.best->set.begin(), found.best->set.end(),
    [&options = data.options()](std::size_t option)
    { return options[option].perChannel && options[option].effect->has(EffectTrait::Exact); });
  if (hasGains && besideChannels < (1.0 - Decision::SmallPart) * inexact && !stop())
  {
    found = SetSearch(data, limits, stop, besideChannels).run();
  }
  return found;
}

} // namespace msi

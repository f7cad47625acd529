#include "Kernels/Gap/GapCauses.h"

#include "Kernels/Gap/ChannelStructure.h"
#include "Kernels/Gap/Shapley.h"
#include "Kernels/Gap/ShrinkInterval.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace msi
{

namespace
{
constexpr int Iterations = 6;
constexpr int AlternativesFitted = 8;
constexpr std::size_t EquivalentNamed = 2;
constexpr double EquivalentPart = 0.02;      // of the gap's energy
constexpr double EquivalentDeviations = 9.0; // dispersions
constexpr double AlikeDoubt = 0.5;

EffectSet subsetOf(const EffectSet& set, std::size_t subset)
{
  EffectSet part = set;
  for (std::size_t e = set.size(); e-- > 0;)
  {
    if ((subset >> e & 1U) == 0)
    {
      part.remove(e);
    }
  }
  return part;
}

EffectSet atStart(const EffectSet& set, const EffectFitter& fitter)
{
  EffectSet fresh;
  for (std::size_t e = 0; e < set.size(); ++e)
  {
    const auto& starts = set.choices[e].form->starts;
    fresh.add(set.choices[e], fitter.data().camera,
      starts.empty() ? std::vector<double>() : starts.front());
    fresh.secondaryFree[e] = 1;
  }
  return fresh;
}

// Shrink of every subset of the effects.
std::vector<double> subsetShrinks(const EffectFitter& fitter, const EffectFit& best)
{
  const std::size_t subsets = std::size_t(1) << best.set.size();
  std::vector<double> shrink{ 0.0 };
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    double reached = 0.0;
    if (subset + 1 == subsets)
    {
      reached = shrinkOf(fitter, best);
    }
    else
    {
      const EffectSet part = subsetOf(best.set, subset);
      reached = shrinkOf(fitter, fitter.fit(part, Iterations));
      // Without the others an effect may be far from where it is with them, and needs the freedom that they gave it.
      if (part.steps() == 0)
      {
        reached =
          std::fmax(reached, shrinkOf(fitter, fitter.fit(atStart(part, fitter), Iterations)));
      }
    }
    shrink.push_back(std::fmax(reached, 0.0));
  }
  return shrink;
}

// The small errors that every camera has in each channel take what the other effects leave: any of them also does, with
// its many parameters, most of what a single number common to the channels does. But where the others can only be seen
// once these errors are out of the way, they get what they do then.
std::vector<double> sharesOf(const EffectSet& set, const std::vector<double>& shrink)
{
  std::vector<std::size_t> leading;
  std::vector<std::size_t> small;
  for (std::size_t e = 0; e < set.size(); ++e)
  {
    (set.choices[e].smallError() ? small : leading).push_back(e);
  }
  const auto together = [](const std::vector<std::size_t>& effects)
  {
    std::size_t subset = 0;
    for (const std::size_t e : effects)
    {
      subset |= std::size_t(1) << e;
    }
    return subset;
  };
  std::vector<double> share(set.size(), 0.0);
  const auto shareAmong = [&](const std::vector<std::size_t>& effects, std::size_t present)
  {
    std::vector<double> value;
    for (std::size_t subset = 0; subset < std::size_t(1) << effects.size(); ++subset)
    {
      std::size_t all = present;
      for (std::size_t p = 0; p < effects.size(); ++p)
      {
        all |= (subset >> p & 1U) != 0 ? std::size_t(1) << effects[p] : 0;
      }
      value.push_back(shrink[all]);
    }
    const std::vector<double> part = shapleyValues(value, effects.size());
    for (std::size_t p = 0; p < effects.size(); ++p)
    {
      share[effects[p]] = std::fmax(part[p], 0.0);
    }
  };
  const double first = shrink[together(leading)];
  const double last = shrink.back() - shrink[together(small)];
  const bool hidden = last > first;
  shareAmong(leading, hidden ? together(small) : 0);
  shareAmong(small, hidden ? 0 : together(leading));
  return share;
}

// A change of the response, weighted, element by element.
Eigen::VectorXd weighted(const EffectFitter& fitter, const Eigen::MatrixXd& change)
{
  const Eigen::ArrayXXd whole =
    (fitter.weight().array() > 0.0).select(fitter.weight().array().sqrt() * change.array(), 0.0);
  return Eigen::Map<const Eigen::VectorXd>(whole.data(), whole.size());
}

// What each effect does to the response where the others are there too, weighted, one column an effect.
Eigen::MatrixXd contributions(const EffectFitter& fitter, const EffectFit& fit)
{
  const GapData& data = fitter.data();
  Eigen::MatrixXd columns(data.observed.size(), static_cast<Eigen::Index>(fit.set.size()));
  for (std::size_t e = 0; e < fit.set.size(); ++e)
  {
    EffectSet rest = fit.set;
    rest.remove(e);
    columns.col(static_cast<Eigen::Index>(e)) =
      weighted(fitter, fit.predicted - respond(data.camera, data.scene, rest));
  }
  return columns;
}

// For each effect the part of what it does, 0..1, that the others undo: as far as they point against it, and are as large
// as it there. What no other can reach is not undone, however large the others are.
std::vector<double> undoneParts(
  const EffectFitter& fitter, const EffectFit& fit, const Eigen::MatrixXd& contribution)
{
  const Eigen::VectorXd all = weighted(fitter, fit.predicted - fitter.data().simulated);
  std::vector<double> undone;
  for (Eigen::Index e = 0; e < contribution.cols(); ++e)
  {
    const double size = contribution.col(e).norm();
    const Eigen::VectorXd others = all - contribution.col(e);
    const double against = -contribution.col(e).dot(others);
    if (!(against > 0.0))
    {
      undone.push_back(0.0);
      continue;
    }
    const double reached = against / others.norm(); // of `size`, along the others
    undone.push_back(reached / size * std::fmin(reached, others.norm()) / size);
  }
  return undone;
}

// For each effect the part of what it does, 0..1, that other effects on the same medium do alike. Two that are that
// similar and are both needed may be one that the library has not got.
std::vector<double> alikeParts(const EffectSet& set, const Eigen::MatrixXd& contribution)
{
  std::vector<double> alike(set.size(), 0.0);
  for (std::size_t e = 0; e < set.size(); ++e)
  {
    std::vector<Eigen::Index> others;
    for (std::size_t o = 0; o < set.size(); ++o)
    {
      if (o != e && !set.choices[e].medium.empty() &&
        set.choices[o].medium == set.choices[e].medium)
      {
        others.push_back(static_cast<Eigen::Index>(o));
      }
    }
    if (others.empty())
    {
      continue;
    }
    Eigen::MatrixXd columns(contribution.rows(), static_cast<Eigen::Index>(others.size()));
    for (std::size_t o = 0; o < others.size(); ++o)
    {
      columns.col(static_cast<Eigen::Index>(o)) = contribution.col(others[o]);
    }
    const Eigen::VectorXd mine = contribution.col(static_cast<Eigen::Index>(e));
    const Eigen::VectorXd rest = mine - columns * columns.colPivHouseholderQr().solve(mine);
    const double size = mine.squaredNorm();
    alike[e] = size > 0.0 ? std::fmax(1.0 - rest.squaredNorm() / size, 0.0) : 0.0;
  }
  return alike;
}

// The part of an effect's share that its own parameters do not belie: gains of single channels that follow one curve
// over the channels are not errors of single channels, unless what is common to them has a cause of its own.
double credible(const EffectSet& set, std::size_t position)
{
  const auto common = [](const EffectChoice& choice)
  { return choice.effect->name == "exposure_gain" || choice.effect->name == "illuminant_drift"; };
  const EffectChoice& choice = set.choices[position];
  if (choice.effect->name != "channel_gain" || !choice.smallError() ||
    std::any_of(set.choices.begin(), set.choices.end(), common))
  {
    return 1.0;
  }
  const std::vector<double>& gain = set.effects[position].parameters;
  const auto channels = static_cast<Eigen::Index>(gain.size());
  const Eigen::VectorXd deviation =
    Eigen::Map<const Eigen::VectorXd>(gain.data(), channels).array() - 1.0;
  const double fraction = commonFraction(deviation);
  const double chance = chanceOfFraction(fraction, CommonDirections, static_cast<int>(channels));
  return chance < StructuredChance ? std::sqrt(1.0 - fraction) : 1.0;
}

// The place of a step lies between two samples; the error is that of a uniform distribution there.
void addPlace(GapCause& cause, const EffectSet& set, std::size_t position, double samples)
{
  std::size_t index = 0;
  for (const EffectParameter& parameter : set.choices[position].form->parameters)
  {
    if (parameter.name == "place")
    {
      cause.parameters.push_back({ parameter.name, set.effects[position].parameters[index],
        parameter.unit, 1.0 / (samples * std::sqrt(12.0)) });
    }
    index += parameter.perChannel ? set.effects[position].parameters.size() -
        (set.choices[position].form->parameters.size() - 1)
                                  : 1;
  }
}

// Effects that do as well in the place of one of the causes.
std::vector<std::string> equivalentsOf(const EffectFitter& fitter, const SearchResult& found,
  const std::vector<EffectChoice>& choices, std::size_t position)
{
  const EffectFit& best = found.best;
  EffectSet rest = best.set;
  rest.remove(position);
  std::vector<EffectChoice> others;
  std::copy_if(choices.begin(), choices.end(), std::back_inserter(others),
    [&](const EffectChoice& choice) {
      return choice.effect->name != best.set.choices[position].effect->name && !rest.has(choice);
    });
  const EffectFit without = rest.size() > 0 ? fitter.fit(rest, Iterations) : fitter.nominal();
  const std::vector<EffectFit> alternatives =
    extendFit(fitter, without, others, found.gapEnergy, AlternativesFitted);
  struct Rival
  {
    std::string name;
    double cost;
  };
  std::vector<Rival> rivals;
  const double price = parameterPrice(fitter, best, found.gapEnergy);
  const auto costOf = [price](const EffectFit& fit)
  { return fit.energy + price * static_cast<double>(fit.parameters()); };
  const double tolerance =
    std::fmax(EquivalentPart * found.gapEnergy, EquivalentDeviations * best.dispersion);
  for (const EffectFit& alternative : alternatives)
  {
    if (costOf(alternative) <= costOf(best) + tolerance)
    {
      rivals.push_back({ alternative.set.choices.back().effect->name, costOf(alternative) });
    }
  }
  std::stable_sort(
    rivals.begin(), rivals.end(), [](const Rival& a, const Rival& b) { return a.cost < b.cost; });
  std::vector<std::string> names;
  for (const Rival& rival : rivals)
  {
    if (names.size() < EquivalentNamed &&
      std::find(names.begin(), names.end(), rival.name) == names.end())
    {
      names.push_back(rival.name);
    }
  }
  return names;
}

// Of the training samples.
SampleEnergies energiesOf(const EffectFitter& fitter, const EffectFit& fit)
{
  const GapData& data = fitter.data();
  SampleEnergies energies;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    double before = 0.0;
    double after = 0.0;
    double noise = 0.0;
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      if (fitter.weight()(k, i) > 0.0)
      {
        const double gap = data.observed(k, i) - data.simulated(k, i);
        before += gap * gap;
        after += fit.heldOut(k, i) * fit.heldOut(k, i);
        noise += data.variance(k, i);
      }
    }
    energies.before.push_back(before);
    energies.after.push_back(after);
    energies.noise.push_back(noise);
  }
  return energies;
}
}

double shrinkOf(double before, double after, double noise) noexcept
{
  const double excess = before - noise;
  if (!(excess > 0.0))
  {
    return 0.0;
  }
  return std::fmax(1.0 - std::sqrt(std::fmax(after - noise, 0.0) / excess), -1.0);
}

double shrinkOf(const EffectFitter& fitter, const EffectFit& fit)
{
  const SampleEnergies energies = energiesOf(fitter, fit);
  const auto sum = [](const std::vector<double>& values)
  { return std::accumulate(values.begin(), values.end(), 0.0); };
  return shrinkOf(sum(energies.before), sum(energies.after), sum(energies.noise));
}

std::vector<GapCause> describeCauses(const EffectFitter& fitter, const SearchResult& found,
  const std::vector<EffectChoice>& choices, double total, double doubt)
{
  const EffectFit& best = found.best;
  const std::size_t count = best.set.size();
  const std::vector<double> alone = subsetShrinks(fitter, best);
  const std::vector<double> share = sharesOf(best.set, alone);
  const double sum = std::accumulate(share.begin(), share.end(), 0.0);
  const Eigen::MatrixXd contribution = contributions(fitter, best);
  const std::vector<double> undone = undoneParts(fitter, best, contribution);
  const std::vector<double> alike = alikeParts(best.set, contribution);
  const Eigen::VectorXd errors = count > 0
    ? Eigen::VectorXd(fitter.covariance(best).diagonal().cwiseMax(0.0).cwiseSqrt())
    : Eigen::VectorXd();
  std::vector<GapCause> causes;
  for (std::size_t e = 0; e < count; ++e)
  {
    GapCause cause;
    cause.effect = best.set.choices[e].effect->name;
    cause.form = best.set.choices[e].form->name;
    cause.medium = best.set.choices[e].medium;
    cause.share = sum > 0.0 ? std::fmax(total, 0.0) * share[e] / sum * (1.0 - doubt * undone[e]) *
        (1.0 - AlikeDoubt * alike[e]) * credible(best.set, e)
                            : 0.0;
    cause.shrink = alone[std::size_t(1) << e];
    cause.undone = undone[e];
    if (e < found.causes)
    {
      cause.equivalent = equivalentsOf(fitter, found, choices, e);
    }
    for (std::size_t p = 0; p < best.free.size(); ++p)
    {
      const FreeParameter& parameter = best.free[p];
      const bool level = parameter.effect == count && best.set.choices[e].leveled;
      if (parameter.effect == e || level)
      {
        cause.parameters.push_back({ parameter.name, valueOf(best.set, parameter), parameter.unit,
          errors[static_cast<Eigen::Index>(p)] });
      }
    }
    addPlace(cause, best.set, e, fitter.trainingSamples());
    causes.push_back(std::move(cause));
  }
  std::stable_sort(causes.begin(), causes.end(),
    [](const GapCause& a, const GapCause& b) { return a.share > b.share; });
  return causes;
}

std::vector<GapCandidate> describeCandidates(
  const EffectFitter& fitter, const SearchResult& found, std::uint64_t seed)
{
  std::vector<GapCandidate> candidates;
  for (const EffectFit& single : found.singles)
  {
    const EffectChoice& choice = single.set.choices.front();
    const double shrink = shrinkOf(fitter, single);
    std::array<double, 2> interval = shrinkInterval(energiesOf(fitter, single), seed);
    interval = { std::fmin(interval[0], shrink), std::fmax(interval[1], shrink) };
    candidates.push_back(
      { choice.effect->name, choice.form->name, choice.medium, shrink, interval });
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const GapCandidate& a, const GapCandidate& b) { return a.shrink > b.shrink; });
  return candidates;
}

} // namespace msi

#include "Kernels/Gap/CauseShares.h"

#include "Kernels/Gap/ChannelStructure.h"
#include "Kernels/Gap/GapCertainty.h"
#include "Kernels/Gap/Shapley.h"
#include "Kernels/Gap/Shrink.h"
#include "Kernels/Gap/TableDecisions.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace msi
{

namespace
{

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
      reached = shrinkOf(fitter, fitter.fit(part, SearchFit));
      // Without the others an effect may be far from where it is with them, and needs the freedom that they gave it.
      if (part.steps() == 0)
      {
        reached =
          std::fmax(reached, shrinkOf(fitter, fitter.fit(atStart(part, fitter), SearchFit)));
      }
    }
    shrink.push_back(std::fmax(reached, 0.0));
  }
  return shrink;
}

// Numbers of single channels that follow one curve over the channels.
struct ChannelCurve
{
  double fraction; // of their energy
  bool certain;    // hardly by chance
  double size;     // of the curve, root mean square over the channels
};

// fromMean: their mean has a cause of its own, the curve is what is left.
ChannelCurve curveOf(const EffectSet& set, std::size_t position, bool fromMean = false)
{
  const std::vector<double>& value = set.effects[position].parameters;
  const auto channels = static_cast<Eigen::Index>(value.size());
  const double neutral = set.choices[position].form->parameters.front().neutral;
  Eigen::VectorXd deviation =
    Eigen::Map<const Eigen::VectorXd>(value.data(), channels).array() - neutral;
  if (fromMean)
  {
    deviation.array() -= deviation.mean();
  }
  const int known = fromMean ? 1 : 0;
  const double fraction = commonFraction(deviation);
  const double chance = chanceOfFraction(
    fraction, TableDecision::CommonDirections - known, static_cast<int>(channels) - known);
  return { fraction, chance < TableDecision::StructuredChance,
    std::sqrt(fraction * deviation.squaredNorm() / static_cast<double>(channels)) };
}

// What all channels have in common is no small error of each; of gains that is a cause of its own, exposure or lamp.
bool isSmallError(const EffectSet& set, std::size_t position)
{
  const EffectChoice& choice = set.choices[position];
  return choice.smallError() &&
    (choice.effect->has(EffectTrait::ChannelGain) || !curveOf(set, position).certain);
}

// The small errors that every camera has in each channel take what the other effects leave: any of them also does, with
// its many parameters, most of what a single number common to the channels does. But where the others do more once these
// errors are out of the way, they get what they do then. The two groups share by energy: by size what comes last would
// weigh too much.
std::vector<double> sharesOf(const EffectSet& set, const std::vector<double>& shrink)
{
  std::vector<std::size_t> leading;
  std::vector<std::size_t> small;
  for (std::size_t e = 0; e < set.size(); ++e)
  {
    (isSmallError(set, e) ? small : leading).push_back(e);
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
  const auto shareAmong =
    [&](const std::vector<std::size_t>& effects, std::size_t present, double part)
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
    std::vector<double> worth = shapleyValues(value, effects.size());
    double sum = 0.0;
    for (double& one : worth)
    {
      one = std::fmax(one, 0.0);
      sum += one;
    }
    for (std::size_t p = 0; p < effects.size() && sum > 0.0; ++p)
    {
      share[effects[p]] = part * worth[p] / sum;
    }
  };
  const auto energy = [&shrink](std::size_t subset)
  { return 1.0 - std::pow(1.0 - shrink[subset], 2); };
  const double all = energy(shrink.size() - 1);
  const double before = energy(together(leading));
  const double beside = all - energy(together(small));
  const double part = all > 0.0 ? std::clamp(std::fmax(before, beside) / all, 0.0, 1.0) : 0.0;
  shareAmong(leading, beside > before ? together(small) : 0, part);
  shareAmong(small, beside > before ? 0 : together(leading), 1.0 - part);
  return share;
}

// What each effect does, one column an effect.
Eigen::MatrixXd contributions(const EffectFitter& fitter, const EffectFit& fit)
{
  Eigen::MatrixXd columns(fit.predicted.size(), static_cast<Eigen::Index>(fit.set.size()));
  for (std::size_t e = 0; e < fit.set.size(); ++e)
  {
    columns.col(static_cast<Eigen::Index>(e)) = fitter.contribution(fit, e);
  }
  return columns;
}

// Scalar products of what the effects do and, last, of what they do together.
Eigen::MatrixXd productsOf(
  const EffectFitter& fitter, const EffectFit& fit, const Eigen::MatrixXd& contribution)
{
  Eigen::MatrixXd columns(contribution.rows(), contribution.cols() + 1);
  columns << contribution, fitter.weighted(fit.predicted - fitter.data().simulated);
  return columns.transpose() * columns;
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

// The part of an effect's share that gains of single channels do not belie. Where they follow one curve over the channels
// they are no errors of single channels, unless the lamp is a cause beside them: something else is there. An exposure
// beside them may be a part of it, as far as the curve is as large as the exposure.
double gainsCredible(const EffectSet& set, std::size_t position)
{
  const auto placeOf = [&set](const auto& wanted)
  {
    return static_cast<std::size_t>(
      std::find_if(set.choices.begin(), set.choices.end(), wanted) - set.choices.begin());
  };
  const auto having = [](EffectTrait::Bit trait)
  { return [trait](const EffectChoice& choice) { return choice.effect->has(trait); }; };
  const std::size_t gains = placeOf([](const EffectChoice& choice)
    { return choice.effect->has(EffectTrait::ChannelGain) && choice.smallError(); });
  const std::size_t exposure = placeOf(having(EffectTrait::CommonGain));
  if ((position != gains && position != exposure) || gains == set.size() ||
    placeOf(having(EffectTrait::SpectralGain)) != set.size())
  {
    return 1.0;
  }
  const bool exposed = exposure != set.size();
  const ChannelCurve curve = curveOf(set, gains, exposed);
  if (!curve.certain)
  {
    return 1.0;
  }
  if (position == gains)
  {
    return std::sqrt(1.0 - curve.fraction);
  }
  const double change = std::fabs(set.effects[exposure].parameters.front() - 1.0);
  return std::fmax(1.0 - curve.size / std::fmax(change, 1e-12), 0.0);
}

// A change over the session that a plain gain does better is none.
bool refuted(const EffectFitter& fitter, const EffectFit& fit, std::size_t position)
{
  const EffectChoice& choice = fit.set.choices[position];
  if (choice.effect->need != EffectNeed::Order || choice.form->has(FormTrait::Adds))
  {
    return false;
  }
  const bool perChannel = choice.form->parameters.front().perChannel;
  const EffectDefinition& gain =
    effectWith(perChannel ? EffectTrait::ChannelGain : EffectTrait::CommonGain);
  const EffectChoice plain{ &gain, &gain.forms.front(), "" };
  if (fit.set.has(plain))
  {
    return false;
  }
  EffectSet set = fit.set;
  set.remove(position);
  set.add(plain, fitter.data().camera);
  const EffectFit other = fitter.fit(std::move(set), SearchFit);
  return other.energy + TableDecision::RefutedDeviations * other.dispersion < fit.energy;
}
}

std::vector<CauseShare> causeShares(
  const EffectFitter& fitter, const EffectFit& fit, double total, double doubt)
{
  const std::vector<double> alone = subsetShrinks(fitter, fit);
  const std::vector<double> share = sharesOf(fit.set, alone);
  const double sum = std::accumulate(share.begin(), share.end(), 0.0);
  const Eigen::MatrixXd contribution = contributions(fitter, fit);
  const std::vector<double> undone = undoneParts(productsOf(fitter, fit, contribution));
  const std::vector<double> alike = alikeParts(fit.set, contribution);
  std::vector<CauseShare> shares;
  for (std::size_t e = 0; e < fit.set.size(); ++e)
  {
    double credit = sum > 0.0 ? std::fmax(total, 0.0) * share[e] / sum : 0.0;
    credit *= (1.0 - doubt * undone[e]) * (1.0 - TableDecision::AlikeDoubt * alike[e]) *
      gainsCredible(fit.set, e) * (refuted(fitter, fit, e) ? 0.0 : 1.0);
    shares.push_back({ credit, alone[std::size_t(1) << e], undone[e] });
  }
  return shares;
}

} // namespace msi

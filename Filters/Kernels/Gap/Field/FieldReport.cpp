#include "Kernels/Gap/Field/FieldReport.h"

#include "Kernels/Gap/Field/FieldDecisions.h"
#include "Kernels/Gap/Field/FieldEffects.h"
#include "Kernels/Gap/Field/FieldGroups.h"
#include "Kernels/Gap/GapCertainty.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Shapley.h"
#include "Kernels/Gap/Shrink.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace msi
{

namespace
{

FieldSet subsetOf(const FieldSet& set, std::size_t subset)
{
  FieldSet part;
  for (std::size_t e = 0; e < set.size(); ++e)
  {
    if ((subset >> e & 1U) != 0)
    {
      part.push_back(set[e]);
    }
  }
  return part;
}

}

std::vector<GapCause> fieldCauses(const FieldData& data, const FieldSearchResult& found,
  const std::vector<FieldChoice>& choices, double total, double doubt)
{
  const FieldFitter fitter(data, found.after);
  const FieldSet& set = found.set;
  const std::size_t subsets = std::size_t(1) << set.size();
  const double chance = fitter.chance();
  const double before = fitter.fit({}).energy;
  std::vector<double> reached(subsets, 0.0);
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    const double energy = fitter.fit(subsetOf(set, subset)).energy;
    reached[subset] = std::fmax(shrinkOf(before, energy, chance), 0.0);
  }
  std::vector<double> share = shapleyValues(reached, set.size());
  double sum = 0.0;
  for (double& part : share)
  {
    part = std::fmax(part, 0.0);
    sum += part;
  }
  const std::vector<double> undone = undoneParts(fitter.contributionProducts(set));
  const FieldFit best = fitter.fit(set);
  const Eigen::VectorXd error = fitter.standardErrors(set);
  const auto costOf = [&](const FieldFit& fit)
  {
    return fit.energy + found.price * static_cast<double>(parameterCount(fit.set, data.channels()));
  };
  Eigen::Index next = 0;
  std::vector<GapCause> causes;
  for (std::size_t e = 0; e < set.size(); ++e)
  {
    GapCause cause;
    cause.effect = set[e]->effect->name;
    cause.form = set[e]->form;
    cause.undone = undone[e];
    cause.share = sum > 0.0 ? total * share[e] / sum * (1.0 - doubt * undone[e]) : 0.0;
    cause.shrink = reached[std::size_t(1) << e];
    cause.parameters = fieldParameters(*set[e], found, data.pair.channels, error, next);
    FieldSet rest = set;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e));
    const double tolerance = std::fmax(ImageDecision::EquivalentPart * found.gapEnergy,
      ImageDecision::EquivalentPrices * found.price);
    std::vector<Rival> rivals;
    for (const FieldChoice& choice : choices)
    {
      if (choice.effect != set[e]->effect && compatible(rest, choice))
      {
        FieldSet other = rest;
        other.push_back(&choice);
        const double cost = costOf(fitter.fit(other));
        if (cost <= costOf(best) + tolerance)
        {
          rivals.push_back({ choice.effect->name, cost });
        }
      }
    }
    cause.equivalent = cheapestOf(std::move(rivals));
    causes.push_back(std::move(cause));
  }
  std::stable_sort(causes.begin(), causes.end(),
    [](const GapCause& a, const GapCause& b) { return a.share > b.share; });
  return causes;
}

std::vector<GapCandidate> fieldCandidates(
  const FieldData& data, const FieldSearchResult& found, std::uint64_t seed)
{
  const Eigen::VectorXd before = FieldFitter(data, found.before).fit({}).blockEnergy;
  Eigen::VectorXd chance = Eigen::VectorXd::Zero(before.size());
  for (Eigen::Index b = 0; b < chance.size(); ++b)
  {
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      chance[b] += found.before.at(static_cast<std::size_t>(b), k).chance;
    }
  }
  std::vector<GapCandidate> candidates;
  for (const FieldSingle& single : found.singles)
  {
    // Cross-validated on the training blocks; the test blocks are for the figures.
    const SampleEnergies energies{ groupSums(data, before, true),
      groupSums(data, single.blockEnergy, true), groupSums(data, chance, true) };
    const auto sum = [](const std::vector<double>& values)
    { return std::accumulate(values.begin(), values.end(), 0.0); };
    candidates.push_back({ single.choice->effect->name, single.choice->form, "",
      shrinkOf(sum(energies.before), sum(energies.after), sum(energies.noise)),
      shrinkInterval(energies, seed) });
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const GapCandidate& a, const GapCandidate& b) { return a.shrink > b.shrink; });
  return candidates;
}

} // namespace msi

#include "Kernels/Gap/Field/FieldReport.h"

#include "Kernels/Gap/GapCauses.h"
#include "Kernels/Gap/Shapley.h"
#include "Kernels/Gap/ShrinkInterval.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double TwoPi = 6.283185307179586;
constexpr double EquivalentPart = 0.02; // of the gap's energy
constexpr double EquivalentPrices = 3.0;
constexpr std::size_t EquivalentNamed = 2;
constexpr double LeastBlur = 1e-4; // pixels^2

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

struct Named
{
  const char* name;
  const char* unit;
};

Named nameOf(FieldParameter parameter)
{
  using P = FieldParameter;
  switch (parameter)
  {
    case P::Gain:
      return { "gain", "1" };
    case P::Dark:
      return { "offset", "white" };
    case P::Glare:
    case P::ConservingGlare:
    case P::TailFraction:
      return { "fraction", "1" };
    case P::GradientRight:
      return { "right", "1" };
    case P::GradientDown:
      return { "down", "1" };
    case P::Falloff:
      return { "falloff", "1" };
    case P::Square:
      return { "square", "1" };
    case P::Right:
      return { "right", "pixels" };
    case P::Down:
      return { "down", "pixels" };
    case P::Magnification:
      return { "magnification", "1" };
    case P::BlurVariance:
      return { "blur", "pixels" };
    case P::TailRadius:
      return { "radius", "pixels" };
    default:
      return { "", "" };
  }
}

std::string withChannel(const std::string& name, const std::string& channel)
{
  return name + "[" + channel + "]";
}

bool isRows(const FieldChoice& choice)
{
  return choice.form == "rows";
}

// amplitude sin(2 pi (row / period + start)) of channel k.
void stripe(const FieldModel& model, bool rows, Eigen::Index k, double& amplitude, double& start)
{
  const double sine = model.at(rows ? FieldParameter::RowSine : FieldParameter::ColumnSine, k);
  const double cosine =
    model.at(rows ? FieldParameter::RowCosine : FieldParameter::ColumnCosine, k);
  amplitude = std::hypot(sine, cosine);
  start = std::atan2(cosine, sine) / TwoPi;
  start -= std::floor(start);
}

std::vector<GapParameter> parametersOf(const FieldChoice& choice, const FieldSearchResult& found,
  const std::vector<std::string>& channels, const Eigen::VectorXd& error, Eigen::Index& next)
{
  const FieldModel& model = found.after.model;
  std::vector<GapParameter> parameters;
  const auto K = static_cast<Eigen::Index>(channels.size());
  if (choice.effect == "banding")
  {
    const FieldPeriod& period = isRows(choice) ? found.rows : found.columns;
    parameters.push_back({ "period", isRows(choice) ? model.rowPeriod : model.columnPeriod,
      "pixels", period.standardError });
    for (Eigen::Index k = 0; k < K; ++k)
    {
      double amplitude = 0.0;
      double start = 0.0;
      stripe(model, isRows(choice), k, amplitude, start);
      const double deviation = std::hypot(error[next + k], error[next + K + k]) / std::sqrt(2.0);
      const std::string& channel = channels[static_cast<std::size_t>(k)];
      parameters.push_back({ withChannel("amplitude", channel), amplitude, "1", deviation });
      parameters.push_back({ withChannel("start", channel), start, "cycle",
        std::fmin(deviation / std::fmax(amplitude, 1e-12) / TwoPi, 0.5) });
    }
    next += 2 * K;
    return parameters;
  }
  for (const FieldTerm& term : choice.terms)
  {
    const Named named = nameOf(term.parameter);
    for (Eigen::Index k = 0; k < (term.perChannel ? K : 1); ++k)
    {
      double value = model.at(term.parameter, k);
      double deviation = error[next++];
      if (term.parameter == FieldParameter::BlurVariance)
      {
        value = std::sqrt(std::fmax(value, 0.0));
        deviation = value > 0.0 ? deviation / (2.0 * value) : std::sqrt(deviation);
      }
      parameters.push_back(
        { term.perChannel ? withChannel(named.name, channels[static_cast<std::size_t>(k)])
                          : named.name,
          value, named.unit, deviation });
    }
  }
  return parameters;
}
}

std::vector<GapCause> fieldCauses(const FieldData& data, const FieldSearchResult& found,
  const std::vector<FieldChoice>& choices, double total)
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
    cause.effect = set[e]->effect;
    cause.form = set[e]->form;
    cause.share = sum > 0.0 ? total * share[e] / sum : 0.0;
    cause.shrink = reached[std::size_t(1) << e];
    cause.parameters = parametersOf(*set[e], found, data.pair.channels, error, next);
    FieldSet rest = set;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(e));
    const double tolerance =
      std::fmax(EquivalentPart * found.gapEnergy, EquivalentPrices * found.price);
    std::vector<std::pair<double, std::string>> rivals;
    for (const FieldChoice& choice : choices)
    {
      if (choice.effect != set[e]->effect && compatible(rest, choice))
      {
        FieldSet other = rest;
        other.push_back(&choice);
        const double cost = costOf(fitter.fit(other));
        if (cost <= costOf(best) + tolerance)
        {
          rivals.emplace_back(cost, choice.effect);
        }
      }
    }
    std::stable_sort(
      rivals.begin(), rivals.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [cost, name] : rivals)
    {
      if (cause.equivalent.size() < EquivalentNamed &&
        std::find(cause.equivalent.begin(), cause.equivalent.end(), name) == cause.equivalent.end())
      {
        cause.equivalent.push_back(name);
      }
    }
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
  std::vector<GapCandidate> candidates;
  for (const FieldSingle& single : found.singles)
  {
    SampleEnergies energies;
    double sums[3] = { 0.0, 0.0, 0.0 };
    for (std::size_t b = 0; b < data.blocks.size(); ++b)
    {
      if (data.blocks[b].fold < 0)
      {
        continue;
      }
      double chance = 0.0;
      for (Eigen::Index k = 0; k < data.channels(); ++k)
      {
        chance += found.before.at(b, k).chance;
      }
      const auto block = static_cast<Eigen::Index>(b);
      energies.before.push_back(before[block]);
      energies.after.push_back(single.blockEnergy[block]);
      energies.noise.push_back(chance);
      sums[0] += before[block];
      sums[1] += single.blockEnergy[block];
      sums[2] += chance;
    }
    candidates.push_back({ single.choice->effect, single.choice->form, "",
      shrinkOf(sums[0], sums[1], sums[2]), shrinkInterval(energies, seed) });
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const GapCandidate& a, const GapCandidate& b) { return a.shrink > b.shrink; });
  return candidates;
}

std::vector<CameraEffect> fieldCorrection(
  const FieldSet& set, const FieldModel& model, const std::vector<std::string>& channels)
{
  const auto K = static_cast<Eigen::Index>(channels.size());
  std::vector<CameraEffect> effects;
  for (const FieldChoice* choice : set)
  {
    CameraEffect effect = neutralEffect(choice->effect, channels, choice->form);
    const std::vector<EffectParameter> names = effectParameters(effect, channels);
    const auto put = [&](const std::string& name, double value)
    {
      for (std::size_t i = 0; i < names.size(); ++i)
      {
        if (names[i].name == name)
        {
          effect.parameters[i] = value;
        }
      }
    };
    if (choice->effect == "banding")
    {
      put("period", isRows(*choice) ? model.rowPeriod : model.columnPeriod);
      for (Eigen::Index k = 0; k < K; ++k)
      {
        double amplitude = 0.0;
        double start = 0.0;
        stripe(model, isRows(*choice), k, amplitude, start);
        put(withChannel("amplitude", channels[static_cast<std::size_t>(k)]), amplitude);
        put(withChannel("start", channels[static_cast<std::size_t>(k)]), start);
      }
    }
    for (const FieldTerm& term : choice->terms)
    {
      for (Eigen::Index k = 0; k < (term.perChannel ? K : 1); ++k)
      {
        const double value = model.at(term.parameter, k);
        const bool blur = term.parameter == FieldParameter::BlurVariance;
        const std::string name = nameOf(term.parameter).name;
        put(term.perChannel ? withChannel(name, channels[static_cast<std::size_t>(k)]) : name,
          blur ? (value > LeastBlur ? std::sqrt(value) : 0.0) : value);
      }
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

} // namespace msi

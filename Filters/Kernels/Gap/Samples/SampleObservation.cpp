#include "Kernels/Gap/Samples/SampleObservation.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/LearnedPrior.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace msi
{

namespace
{
constexpr FitEffort NoStep{ 0, 1.0 };

const SampleFit& sampleFit(const ObservedFit& fit)
{
  return static_cast<const SampleFit&>(fit);
}

std::vector<GapOption> gapOptions(const std::vector<EffectChoice>& choices, const GapData& data)
{
  std::vector<GapOption> options;
  for (const EffectChoice& choice : choices)
  {
    const auto& parameters = choice.form->parameters;
    const bool onlyMedium = !choice.medium.empty() && data.scene.media().size() == 1;
    options.push_back({ choice.effect, choice.form->name, choice.medium,
      std::any_of(parameters.begin(), parameters.end(),
        [](const EffectParameter& parameter) { return parameter.perChannel && !parameter.given; }),
      Decision::EffectImprobability +
        Decision::FormImprobability *
          static_cast<double>(
            choice.form - choice.effect->forms.data() + (choice.whiteAfter ? 1 : 0)) +
        (choice.form->has(FormTrait::Brightens) && !choice.whiteAfter
            ? Decision::EffectImprobability
            : 0.0) +
        (onlyMedium ? Decision::EffectImprobability : 0.0) });
  }
  return options;
}

// With the secondary parameters of one effect free, where that predicts better.
EffectFit withSecondary(const EffectFitter& fitter, EffectFit fit, std::size_t position)
{
  const std::vector<EffectParameter>& parameters = fit.set.choices[position].form->parameters;
  if (std::none_of(parameters.begin(), parameters.end(),
        [](const EffectParameter& parameter) { return parameter.secondary && !parameter.given; }))
  {
    return fit;
  }
  EffectSet freed = fit.set;
  freed.secondaryFree[position] = 1;
  EffectFit other = fitter.fit(std::move(freed), SearchFit.unwantedAbove(fit.energy));
  return other.energy + Decision::SureDeviations * other.dispersion < fit.energy ? other : fit;
}

std::vector<FreeNumber> numbersOf(const EffectFit& fit)
{
  std::vector<FreeNumber> numbers;
  for (const FreeParameter& parameter : fit.free)
  {
    const bool perChannel = parameter.channel >= 0;
    const auto hasCommonForm = [&fit, &parameter]
    {
      const auto& plain = fit.set.choices[parameter.effect].effect->forms.front().parameters;
      return std::none_of(
        plain.begin(), plain.end(), [](const EffectParameter& one) { return one.perChannel; });
    };
    numbers.push_back({ parameter.group, perChannel, perChannel && hasCommonForm(),
      valueOf(fit.set, parameter) - parameter.neutral, parameter.spread, parameter.scale });
  }
  return numbers;
}
}

SampleObservation::SampleObservation(const GapData& data, std::vector<char> training,
  const std::vector<EffectChoice>& choices, std::uint64_t seed)
  : Fitter(data, std::move(training), seed)
  , Choices(choices)
  , Options(gapOptions(choices, data))
{
}

FitPointer SampleObservation::nominal() const
{
  return described(Fitter.nominal(), {});
}

EffectFit SampleObservation::linearised(const ObservedFit& fit) const
{
  return Fitter.fit(sampleFit(fit).effects, NoStep);
}

EffectFit SampleObservation::whole(const ObservedFit& fit) const
{
  return Fitter.fit(sampleFit(fit).effects, FinalFit);
}

FitPointer SampleObservation::extended(const ObservedFit& from, const GapPreview& with) const
{
  EffectSet effects = sampleFit(from).effects;
  effects.add(Choices[with.option], Fitter.data().camera, with.start);
  std::vector<std::size_t> set = from.set;
  set.push_back(with.option);
  return described(
    withSecondary(Fitter, Fitter.fit(std::move(effects), SearchFit), from.set.size()),
    std::move(set));
}

FitPointer SampleObservation::reduced(const ObservedFit& from, std::size_t positions) const
{
  EffectSet effects = sampleFit(from).effects;
  std::vector<std::size_t> set = from.set;
  for (std::size_t p = set.size(); p-- > 0;)
  {
    if ((positions >> p & 1U) == 0)
    {
      effects.remove(p);
      set.erase(set.begin() + static_cast<std::ptrdiff_t>(p));
    }
  }
  return described(Fitter.fit(std::move(effects), SearchFit), std::move(set));
}

FitPointer SampleObservation::described(EffectFit fit, std::vector<std::size_t> set) const
{
  auto described = std::make_shared<SampleFit>();
  described->set = std::move(set);
  described->energy = fit.energy;
  described->coherence = fit.energy > 0.0
    ? fit.dispersion * std::fmax(Fitter.trainingElements(), 1.0) / fit.energy
    : 1.0;
  for (const FreeParameter& parameter : fit.free)
  {
    const double value = valueOf(fit.set, parameter);
    described->atBound = described->atBound || value <= parameter.lower || value >= parameter.upper;
  }
  const LearnedPrior prior(numbersOf(fit));
  described->information = prior.informationOf(fit.informationOfData());
  described->surprise = prior.surprise;
  described->chanceOfCurve = prior.chanceOfCurve;
  // The place of a step is a number, too, found among those of the samples.
  described->surprise += static_cast<double>(fit.set.steps()) * std::log(Fitter.trainingSamples());
  described->effects = std::move(fit.set);
  return described;
}

GroupEnergies SampleObservation::energies(const ObservedFit& fit) const
{
  return energies(linearised(fit));
}

GroupEnergies SampleObservation::energies(const EffectFit& fit) const
{
  const GapData& data = Fitter.data();
  GroupEnergies energies;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    const auto with = Fitter.weight().col(i).array() > 0.0;
    if (with.any())
    {
      const auto sum = [&with](const auto& values) { return with.select(values, 0.0).sum(); };
      energies.before.push_back(
        sum((data.observed.col(i) - data.simulated.col(i)).array().square()));
      energies.after.push_back(sum(fit.heldOut.col(i).array().square()));
      energies.noise.push_back(sum(data.variance.col(i).array()));
    }
  }
  return energies;
}

std::vector<std::vector<GapParameter>> SampleObservation::parameters(const ObservedFit& fit) const
{
  const EffectFit whole = linearised(fit);
  std::vector<std::vector<GapParameter>> all(whole.set.size());
  if (whole.set.size() == 0)
  {
    return all;
  }
  const Eigen::VectorXd error = Fitter.covariance(whole).diagonal().cwiseMax(0.0).cwiseSqrt();
  for (std::size_t e = 0; e < whole.set.size(); ++e)
  {
    for (std::size_t p = 0; p < whole.free.size(); ++p)
    {
      const FreeParameter& parameter = whole.free[p];
      if (parameter.effect == e ||
        (parameter.effect == whole.set.size() && whole.set.choices[e].leveled))
      {
        all[e].push_back({ parameter.name, valueOf(whole.set, parameter), parameter.unit,
          error[static_cast<Eigen::Index>(p)] });
      }
    }
    // The place of a step lies between two samples; the error is that of a uniform distribution there.
    if (const auto place = whole.set.placeOf(e))
    {
      all[e].push_back({ place->parameter->name, whole.set.effects[e].parameters[place->index],
        place->parameter->unit, 1.0 / (Fitter.trainingSamples() * std::sqrt(12.0)) });
    }
  }
  return all;
}

} // namespace msi

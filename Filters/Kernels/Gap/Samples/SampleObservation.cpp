#include "Kernels/Gap/Samples/SampleObservation.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/LinearFit.h"
#include "Kernels/Gap/Samples/OrderBreaks.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

std::vector<GapOption> gapOptions(const std::vector<EffectChoice>& choices)
{
  std::vector<GapOption> options;
  for (const EffectChoice& choice : choices)
  {
    const EffectParameter& first = choice.form->parameters.front();
    const bool besideLine = choice.form->has(FormTrait::BesideLine);
    const auto place = choice.form - choice.effect->forms.data() + (choice.whiteAfter ? 1 : 0);
    options.push_back({ choice.effect, choice.form->name, choice.medium,
      first.perChannel && !first.followsLight,
      besideLine
        ? Decision::StandIn
        : Decision::EffectImprobability + Decision::FormImprobability * static_cast<double>(place),
      besideLine, choice.form->has(FormTrait::Brightens) && !choice.whiteAfter });
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

// No square yet, and slope and constant of the line through the squared signals of each channel.
std::vector<double> besideLine(const GapData& data)
{
  const auto known = data.weight.array() > 0.0;
  const Eigen::ArrayXXd u = known.select(data.simulated.colwise() - data.camera.dark(), 0.0);
  const Eigen::ArrayXd n = known.cast<double>().rowwise().sum();
  const Eigen::ArrayXd x = u.rowwise().sum();
  const Eigen::ArrayXd xx = u.square().rowwise().sum();
  const Eigen::ArrayXd xxx = u.cube().rowwise().sum();
  const Eigen::ArrayXd spread = n * xx - x * x;
  const Eigen::ArrayXd slope = (n * xxx - x * xx) / spread;
  const auto told = spread > 1e-9 * n * xx;
  std::vector<double> start(1 + 2 * data.channels(), 0.0);
  Eigen::Map<Eigen::ArrayXd>(start.data() + 1, start.size() - 1) << told.select(slope, 0.0),
    told.select((xx - slope * x) / n, 0.0);
  return start;
}

std::vector<std::vector<double>> startsOf(
  const EffectChoice& choice, const GapData& data, const OrderBreaks& breaks)
{
  const std::vector<EffectParameter>& parameters = choice.form->parameters;
  if (std::any_of(parameters.begin(), parameters.end(),
        [](const EffectParameter& parameter) { return parameter.searched; }))
  {
    return breaks.startsFor(*choice.form);
  }
  if (choice.form->has(FormTrait::BesideLine))
  {
    return { besideLine(data) };
  }
  std::vector<std::vector<double>> starts = choice.form->starts;
  if (choice.effect->has(EffectTrait::LimitsResponse))
  {
    const bool perChannel = parameters.front().perChannel;
    const Eigen::VectorXd largest = perChannel
      ? Eigen::VectorXd(data.observed.rowwise().maxCoeff())
      : Eigen::VectorXd::Constant(1, data.observed.maxCoeff());
    std::vector<double>& start = starts.emplace_back();
    for (const double level : largest)
    {
      start.push_back(0.98 * level);
    }
    start.push_back(choice.form->starts.front()[1]);
  }
  return starts;
}
}

SampleObservation::SampleObservation(const GapData& data, SampleList training,
  const std::vector<EffectChoice>& choices, std::uint64_t seed)
  : Fitter(data, std::move(training), seed)
  , Choices(choices)
{
  Options = gapOptions(choices);
  ChannelNumbers = data.channels();
  Elements = Fitter.trainingElements();
  NoiseEnergy = Fitter.noiseEnergy();
  InexactEnergy = { energyBesideGain(data, Fitter.weight(), false),
    energyBesideGain(data, Fitter.weight(), true) };
  Nominal = described(Fitter.nominal(), {});
}

EffectFit SampleObservation::linearised(const ObservedFit& fit) const
{
  return Fitter.fit(sampleFit(fit).effects, NoStep);
}

EffectFit SampleObservation::whole(const ObservedFit& fit) const
{
  return Fitter.fit(sampleFit(fit).effects, FinalFit);
}

std::vector<GapPreview> SampleObservation::previews(const ObservedFit& from) const
{
  const EffectFit present = linearised(from);
  const GapData& data = Fitter.data();
  const std::optional<StagedResponse> response =
    stagedResponse(data.camera, data.scene, present.set);
  std::vector<GapPreview> previews;
  if (!response)
  {
    return previews;
  }
  const OrderBreaks breaks(Fitter, response->response());
  for (std::size_t option = 0; option < Choices.size(); ++option)
  {
    const EffectChoice& choice = Choices[option];
    if (std::any_of(from.set.begin(), from.set.end(),
          [&](std::size_t other) { return Options[other].sameCause(Options[option]); }))
    {
      continue;
    }
    std::vector<std::vector<double>> starts = startsOf(choice, data, breaks);
    if (starts.empty())
    {
      starts.emplace_back();
    }
    std::vector<std::size_t> numbers = from.set;
    numbers.push_back(option);
    GapPreview best;
    best.option = option;
    best.fit.set = numbers;
    best.fit.energy = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& start : starts)
    {
      EffectSet set = present.set;
      set.add(choice, data.camera, start);
      if (auto fit = Fitter.oneStep(present, *response, std::move(set));
          fit && fit->energy < best.fit.energy)
      {
        best.start = start;
        best.fit = ObservedFit();
        describe(best.fit, *fit, fit->linear.step());
        best.fit.set = numbers;
      }
    }
    previews.push_back(std::move(best));
  }
  return previews;
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
  const bool whiteAfter = effects.whiteAfterEffects();
  std::vector<std::size_t> set = from.set;
  for (std::size_t p = set.size(); p-- > 0;)
  {
    if ((positions >> p & 1U) == 0)
    {
      effects.remove(p);
      set.erase(set.begin() + p);
    }
  }
  // The white stays as it was, also where the option that said so is gone.
  for (std::size_t p = 0; p < set.size() && whiteAfter && !effects.whiteAfterEffects(); ++p)
  {
    const auto twin = std::find_if(Choices.begin(), Choices.end(),
      [&own = effects.choices[p]](const EffectChoice& other)
      { return other.whiteAfter && other.form == own.form && other.leveled == own.leveled; });
    if (twin != Choices.end())
    {
      effects.choices[p] = *twin;
      set[p] = twin - Choices.begin();
    }
  }
  return described(Fitter.fit(std::move(effects), SearchFit), std::move(set));
}

void SampleObservation::describe(
  ObservedFit& described, const EffectFit& fit, const Eigen::VectorXd& step) const
{
  described.energy = fit.energy;
  described.coherence = fit.energy > 0.0
    ? fit.dispersion * std::fmax(Fitter.trainingElements(), 1.0) / fit.energy
    : 1.0;
  fit.linear.describe(described, step);
  // The place of a step is a number, too, found among those of the samples.
  described.surprise +=
    static_cast<double>(fit.set.steps()) * std::log(static_cast<double>(Fitter.training().size()));
}

FitPointer SampleObservation::described(EffectFit fit, std::vector<std::size_t> set) const
{
  auto described = std::make_shared<SampleFit>();
  describe(*described, fit, Eigen::VectorXd::Zero(fit.free.size()));
  described->set = std::move(set);
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
  const Eigen::MatrixXd before = measuredOnly(data, data.observed - data.simulated);
  return energiesOf(data, Fitter.training(), before, fit.heldOut);
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
        all[e].push_back(
          { parameter.name, whole.set.value(parameter), parameter.definition->unit, error[p] });
      }
    }
    // The place of a step lies between two samples; the error is that of a uniform distribution there.
    if (const auto place = whole.set.placeOf(e))
    {
      all[e].push_back({ place->parameter->name, whole.set.effects[e].parameters[place->index],
        place->parameter->unit,
        1.0 / (static_cast<double>(Fitter.training().size()) * std::sqrt(12.0)) });
    }
  }
  return all;
}

} // namespace msi

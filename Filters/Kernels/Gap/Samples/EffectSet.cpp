#include "Kernels/Gap/Samples/EffectSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr double RelativeStep = 1e-3; // of a parameter's typical size

CameraSimulatorOptions optionsOf(const EffectSet& set)
{
  return { set.whiteAfterEffects() };
}

// Nothing for a trial that leaves a channel without light.
template <typename Simulate>
auto litOrNothing(Simulate simulate) -> std::optional<decltype(simulate())>
{
  try
  {
    return simulate();
  }
  catch (const std::invalid_argument&)
  {
    return std::nullopt;
  }
}

// The effect that carries the level of the choices that are leveled.
const EffectDefinition& levelEffect()
{
  return effectWith(EffectTrait::CommonGain);
}
}

bool EffectSet::whiteAfterEffects() const noexcept
{
  return std::any_of(
    choices.begin(), choices.end(), [](const EffectChoice& choice) { return choice.whiteAfter; });
}

bool EffectSet::leveled() const noexcept
{
  return std::any_of(choices.begin(), choices.end(),
           [](const EffectChoice& choice) { return choice.leveled; }) &&
    std::none_of(choices.begin(), choices.end(),
      [](const EffectChoice& choice) { return choice.effect->has(EffectTrait::CommonGain); });
}

std::size_t EffectSet::steps() const
{
  std::size_t count = 0;
  for (std::size_t e = 0; e < size(); ++e)
  {
    count += placeOf(e) ? 1 : 0;
  }
  return count;
}

Eigen::Index EffectSet::reach() const noexcept
{
  const bool coupled = std::any_of(choices.begin(), choices.end(),
    [](const EffectChoice& choice) { return choice.effect->has(EffectTrait::CouplesChannels); });
  return coupled ? 1 : 0;
}

std::vector<CameraEffect> EffectSet::simulated() const
{
  std::vector<CameraEffect> all = effects;
  if (leveled())
  {
    all.push_back({ levelEffect().name, "", "", { level } });
  }
  return all;
}

void EffectSet::add(
  const EffectChoice& choice, const CameraModel& camera, const std::vector<double>& start)
{
  choices.push_back(choice);
  effects.push_back(
    neutralEffect(choice.effect->name, camera.channels(), choice.form->name, choice.medium));
  secondaryFree.push_back(0);
  if (start.size() == effects.back().parameters.size())
  {
    effects.back().parameters = start;
  }
  else if (!start.empty())
  {
    std::size_t at = 0;
    for (std::size_t p = 0; p < choice.form->parameters.size(); ++p)
    {
      const std::size_t count =
        choice.form->parameters[p].perChannel ? camera.channels().size() : 1;
      std::fill_n(effects.back().parameters.begin() + at, count, start[p]);
      at += count;
    }
  }
}

void EffectSet::remove(std::size_t position)
{
  choices.erase(choices.begin() + position);
  effects.erase(effects.begin() + position);
  secondaryFree.erase(secondaryFree.begin() + position);
}

std::optional<StepPlace> EffectSet::placeOf(std::size_t position) const
{
  const std::vector<EffectParameter>& parameters = choices[position].form->parameters;
  std::size_t index = 0;
  for (const EffectParameter& parameter : parameters)
  {
    if (parameter.searched)
    {
      return StepPlace{ index, &parameter };
    }
    // At most one parameter of a form with a step has a number for each channel.
    index +=
      parameter.perChannel ? effects[position].parameters.size() - (parameters.size() - 1) : 1;
  }
  return std::nullopt;
}

std::vector<FreeParameter> EffectSet::freeParameters(const CameraModel& camera) const
{
  std::vector<FreeParameter> free;
  std::size_t group = 0;
  const auto add = [&](const EffectParameter& parameter, std::size_t e, std::size_t index,
                     Eigen::Index channel, bool hasCommonForm, const std::string& name)
  {
    const double neutral = parameter.neutral;
    free.push_back({ { group, parameter.perChannel, hasCommonForm, 0.0, parameter.typical, 0.0,
                       parameter.lower - neutral, parameter.upper - neutral },
      e, index, channel, &parameter, name });
    free.back().deviation = value(free.back()) - neutral;
    free.back().mayFollowCurve =
      parameter.followsLight || (e < choices.size() && choices[e].form->has(FormTrait::Adds));
  };
  for (std::size_t e = 0; e < effects.size(); ++e)
  {
    const bool hasCommonForm = choices[e].effect->hasCommonForm();
    std::size_t index = 0;
    for (const EffectParameter& parameter : choices[e].form->parameters)
    {
      const auto count = parameter.perChannel ? camera.channelCount() : Eigen::Index(1);
      const bool isFree =
        !parameter.searched && !parameter.given && (!parameter.secondary || secondaryFree[e] != 0);
      for (Eigen::Index k = 0; k < count; ++k, ++index)
      {
        if (isFree && parameter.perChannel)
        {
          add(parameter, e, index, k, hasCommonForm,
            parameter.name + "[" + camera.channels()[k] + "]");
        }
        else if (isFree)
        {
          add(parameter, e, index, -1, hasCommonForm, parameter.name);
        }
      }
      ++group;
    }
  }
  if (leveled())
  {
    add(levelEffect().forms.front().parameters.front(), effects.size(), 0, -1, true, "level");
  }
  return free;
}

double& EffectSet::value(const FreeParameter& parameter)
{
  return parameter.effect < effects.size() ? effects[parameter.effect].parameters[parameter.index]
                                           : level;
}

double EffectSet::value(const FreeParameter& parameter) const
{
  return parameter.effect < effects.size() ? effects[parameter.effect].parameters[parameter.index]
                                           : level;
}

EffectSet changed(
  EffectSet set, const std::vector<FreeParameter>& free, const Eigen::VectorXd& change)
{
  for (std::size_t p = 0; p < free.size(); ++p)
  {
    const EffectParameter& bounds = *free[p].definition;
    double& value = set.value(free[p]);
    value = std::clamp(value + change[p], bounds.lower, bounds.upper);
  }
  return set;
}

std::optional<StagedResponse> stagedResponse(
  const CameraModel& camera, const SampleScene& scene, const EffectSet& set)
{
  return litOrNothing(
    [&] { return StagedResponse(camera, scene, set.simulated(), optionsOf(set)); });
}

std::optional<StagedResponse> stagedResponse(const StagedResponse& related, const EffectSet& set)
{
  return litOrNothing([&] { return StagedResponse(related, set.simulated(), optionsOf(set)); });
}

std::vector<Derivative> derivatives(
  const StagedResponse& here, const EffectSet& set, const std::vector<FreeParameter>& free)
{
  const Eigen::MatrixXd& base = here.response();
  const Eigen::Index reach = set.reach();
  const Eigen::Index colors = 2 * reach + 1;
  const Eigen::Index channels = base.rows();
  std::vector<Derivative> derivatives(free.size());
  const auto stepOf = [&](const FreeParameter& parameter)
  {
    const double step = RelativeStep * parameter.typical;
    return set.value(parameter) + step > parameter.definition->upper ? -step : step;
  };
  std::size_t first = 0;
  while (first < free.size())
  {
    std::size_t last = first + 1;
    while (last < free.size() && free[last].group == free[first].group)
    {
      ++last;
    }
    const bool perChannel = free[first].channel >= 0;
    for (Eigen::Index color = 0; color < (perChannel ? colors : 1); ++color)
    {
      EffectSet moved = set;
      for (std::size_t p = first; p < last; ++p)
      {
        if (!perChannel || free[p].channel % colors == color)
        {
          moved.value(free[p]) = set.value(free[p]) + stepOf(free[p]);
        }
      }
      const std::optional<StagedResponse> there = stagedResponse(here, moved);
      for (std::size_t p = first; p < last; ++p)
      {
        if (perChannel && free[p].channel % colors != color)
        {
          continue;
        }
        const Eigen::Index low =
          perChannel ? std::max<Eigen::Index>(free[p].channel - reach, 0) : 0;
        const Eigen::Index end =
          perChannel ? std::min(free[p].channel + reach + 1, channels) : channels;
        derivatives[p] = { low, Eigen::MatrixXd::Zero(end - low, base.cols()) };
        if (there)
        {
          const Eigen::ArrayXXd change =
            (derivatives[p].of(there->response()) - derivatives[p].of(base)) / stepOf(free[p]);
          derivatives[p].changes = change.isFinite().select(change, 0.0);
        }
      }
    }
    first = last;
  }
  return derivatives;
}

bool canShow(const SampleScene& scene, const EffectDefinition& effect, const std::string& medium)
{
  const std::vector<std::string>& media = scene.media();
  return (effect.need != EffectNeed::Position || scene.hasPositions()) &&
    (effect.need != EffectNeed::Order || scene.hasOrder()) &&
    (effect.need != EffectNeed::Medium ||
      (!medium.empty() && std::find(media.begin(), media.end(), medium) != media.end()));
}

std::vector<std::string> mediaOfSeveralSamples(const SampleScene& scene)
{
  std::vector<std::string> media;
  for (std::size_t m = 0; m < scene.media().size(); ++m)
  {
    if (std::count(scene.medium().begin(), scene.medium().end(), static_cast<int>(m)) > 1)
    {
      media.push_back(scene.media()[m]);
    }
  }
  return media;
}

std::vector<EffectChoice> choicesFor(
  const SampleScene& scene, const std::vector<std::string>& without)
{
  const auto barred = [&without](const std::string& name)
  { return std::find(without.begin(), without.end(), name) != without.end(); };
  const bool mayBrighten = !barred(levelEffect().name);
  const std::vector<std::string> media = mediaOfSeveralSamples(scene);
  const std::vector<std::string> noMedium(1);
  std::vector<EffectChoice> choices;
  for (const EffectDefinition& effect : effectLibrary())
  {
    if (effect.stage == EffectStage::Noise || effect.stage == EffectStage::Image ||
      effect.has(EffectTrait::Remainder) || barred(effect.name))
    {
      continue;
    }
    for (const std::string& medium : effect.need == EffectNeed::Medium ? media : noMedium)
    {
      if (!canShow(scene, effect, medium))
      {
        continue;
      }
      for (const EffectForm& form : effect.forms)
      {
        if (form.has(FormTrait::OfImages) ||
          (form.has(FormTrait::OfField) && !scene.hasPositions()))
        {
          continue;
        }
        // Where a common gain may not be blamed nothing else may carry one in disguise.
        if (!form.has(FormTrait::Brightens) || mayBrighten)
        {
          choices.push_back({ &effect, &form, medium });
        }
        if (effect.stage == EffectStage::Responsivity && !form.has(FormTrait::KeepsWhite))
        {
          choices.push_back({ &effect, &form, medium, true });
        }
        if (effect.has(EffectTrait::SpectralGain) && mayBrighten)
        {
          choices.push_back({ &effect, &form, medium, false, true });
        }
      }
    }
  }
  return choices;
}

} // namespace msi

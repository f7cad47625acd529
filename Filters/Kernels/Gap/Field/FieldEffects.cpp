#include "Kernels/Gap/Field/FieldEffects.h"

#include "Kernels/Gap/Field/FieldStarts.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
std::string withChannel(const std::string& name, const std::string& channel)
{
  return name + "[" + channel + "]";
}

// "", "_2", "_3"
std::string harmonicName(Eigen::Index n)
{
  return n == 0 ? std::string() : "_" + std::to_string(n + 1);
}

// Lines of stripes' parameters, errors from `next` on.
std::vector<GapParameter> bandingParameters(const FieldChoice& choice, const FieldModel& model,
  const std::vector<std::string>& channels, const Eigen::VectorXd& error, Eigen::Index& next)
{
  const Eigen::Index K = channels.size();
  const BandingSines sines = bandingSines(choice, model);
  const bool profile = isProfile(choice);
  std::vector<GapParameter> parameters;
  parameters.push_back({ "period", sines.period, "pixels",
    profile ? 0.0 : model.stripes(isOfRows(choice)).periodError });
  if (profile)
  {
    parameters.push_back({ "rms", sines.rms, isOffset(choice) ? "white" : "1", 0.0 });
    parameters.push_back({ "periodic_part", sines.part, "1", 0.0 });
  }
  for (Eigen::Index k = 0; k < K; ++k)
  {
    const std::string& channel = channels[k];
    for (Eigen::Index n = 0; n < sines.amplitude.cols(); ++n)
    {
      const double amplitude = sines.amplitude(k, n);
      // The strength of a profile scales all of its sines.
      const double deviation = profile
        ? error[next + k] * amplitude / std::fmax(model.at(choice.terms.front().parameter, k), 1e-3)
        : std::hypot(error[next + k], error[next + K + k]) / std::sqrt(2.0);
      parameters.push_back({ withChannel("amplitude" + harmonicName(n), channel), amplitude,
        isOffset(choice) ? "white" : "1", deviation });
      parameters.push_back({ withChannel("start" + harmonicName(n), channel), sines.start(k, n),
        "cycle", std::fmin(deviation / std::fmax(amplitude, 1e-12) / TwoPi, 0.5) });
    }
  }
  next += profile ? K : 2 * K;
  return parameters;
}
}

std::vector<FieldChoice> fieldChoices(const std::vector<std::string>& without)
{
  requireKnown(without);
  const auto barred = [&without](const std::string& name)
  { return std::find(without.begin(), without.end(), name) != without.end(); };
  const bool mayBrighten = !barred(effectWith(EffectTrait::CommonGain).name);
  std::vector<FieldChoice> choices;
  for (const EffectDefinition& effect : effectLibrary())
  {
    if (effect.has(EffectTrait::Remainder) || barred(effect.name))
    {
      continue;
    }
    for (const ImageForm& form : effect.imageForms)
    {
      // Where a common gain may not be blamed nothing else may carry one in disguise.
      if (!form.brightens || mayBrighten)
      {
        choices.push_back({ form, &effect });
      }
    }
  }
  // Of effects that do as well the exact ones come first.
  std::stable_partition(choices.begin(), choices.end(),
    [](const FieldChoice& choice) { return choice.has(EffectTrait::Exact); });
  return choices;
}

bool isBanding(const FieldChoice& choice)
{
  return choice.stage() == ImageStage::Lines;
}

bool isProfile(const FieldChoice& choice)
{
  return isBanding(choice) && choice.terms.size() == 1;
}

bool isOffset(const FieldChoice& choice)
{
  return isProfile(choice) && choice.form.find("offset") != std::string::npos;
}

bool isOfRows(const FieldChoice& choice)
{
  return choice.form.rfind("row", 0) == 0;
}

bool extends(const FieldChoice& choice, const FieldChoice& other)
{
  return choice.effect == other.effect && choice.terms.size() > other.terms.size() &&
    std::all_of(other.terms.begin(), other.terms.end(),
      [&choice](const ImageTerm& term)
      {
        return std::any_of(choice.terms.begin(), choice.terms.end(),
          [&term](const ImageTerm& own)
          { return own.parameter == term.parameter && own.perChannel == term.perChannel; });
      });
}

bool compatible(const FieldSet& set, const FieldChoice& choice)
{
  for (const FieldChoice* other : set)
  {
    if (extends(choice, *other))
    {
      continue;
    }
    const bool bothBands =
      isBanding(*other) && isBanding(choice) && isOfRows(*other) != isOfRows(choice);
    if (other == &choice || (other->effect == choice.effect && !bothBands) ||
      other->terms.front().parameter == choice.terms.front().parameter)
    {
      return false;
    }
  }
  return true;
}

AskedSteps stepsOf(const FieldSet& set)
{
  AskedSteps asked;
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
    {
      asked.insert(&stepOf(term.parameter));
    }
  }
  return asked;
}

std::vector<FieldNumber> numbersOf(const FieldSet& set, const FieldModel& model)
{
  std::vector<FieldNumber> numbers;
  for (const FieldChoice* choice : set)
  {
    const bool hasCommonForm = choice->effect->hasCommonForm();
    const bool isPattern = choice->effect->stage == EffectStage::Image;
    // An offset is over the counts of white, which follow the light and the exposure.
    const bool adds = findForm(*choice->effect, choice->form)->has(FormTrait::Adds);
    for (const ImageTerm& term : choice->terms)
    {
      const ImageNumber& kind = numberOf(term.parameter);
      for (Eigen::Index k = 0; k < (term.perChannel ? model.channels() : 1); ++k)
      {
        const double deviation = model.at(term.parameter, k) - kind.neutral;
        numbers.push_back(
          { { term.parameter, term.perChannel, hasCommonForm, deviation, term.typical, 0.0,
              term.lower - kind.neutral, term.upper - kind.neutral,
              kind.pull == ImagePull::Neutral ? 0.0 : deviation, kind.pull == ImagePull::Itself,
              isPattern || adds || term.followsLight, term.mayEnd || term.name.empty() },
            &term, term.perChannel ? k : -1 });
      }
    }
  }
  return numbers;
}

std::vector<GapParameter> fieldParameters(const FieldChoice& choice, const FieldModel& model,
  const std::vector<std::string>& channels, const Eigen::VectorXd& error, Eigen::Index& next)
{
  std::vector<GapParameter> parameters;
  if (isBanding(choice))
  {
    return bandingParameters(choice, model, channels, error, next);
  }
  for (const FieldNumber& number : numbersOf({ &choice }, model))
  {
    const ImageTerm& term = *number.term;
    const Eigen::Index k = std::max<Eigen::Index>(number.channel, 0);
    double value = model.at(term.parameter, k);
    double deviation = error[next++];
    if (term.squared)
    {
      value = std::sqrt(std::fmax(value, 0.0));
      deviation = value > 0.0 ? deviation / (2.0 * value) : std::sqrt(deviation);
    }
    if (!term.name.empty())
    {
      parameters.push_back({ term.perChannel ? withChannel(term.name, channels[k]) : term.name,
        value, term.unit, deviation });
    }
  }
  return parameters;
}

std::vector<CameraEffect> fieldCorrection(
  const FieldSet& set, const FieldModel& model, const std::vector<std::string>& channels)
{
  std::vector<CameraEffect> effects;
  for (const FieldChoice* choice : set)
  {
    CameraEffect effect = neutralEffect(choice->effect->name, channels, choice->form);
    const std::vector<EffectParameter> names = effectParameters(effect, channels);
    const std::size_t numbers = numbersOf({ choice }, model).size();
    const Eigen::VectorXd exact = Eigen::VectorXd::Zero(numbers);
    Eigen::Index next = 0;
    for (const GapParameter& found : fieldParameters(*choice, model, channels, exact, next))
    {
      for (std::size_t i = 0; i < names.size(); ++i)
      {
        if (names[i].name == found.name)
        {
          effect.parameters[i] = std::clamp(found.value, names[i].lower, names[i].upper);
        }
      }
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

} // namespace msi

#include "Kernels/Gap/Field/FieldEffects.h"

#include "Kernels/Gap/Field/FieldColumns.h"
#include "Kernels/Gap/Field/FieldStripes.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msi
{

namespace
{
// What a profile counts for beside its strength. Its lines are no parameters: blocks that took no part in it judge it.
constexpr Eigen::Index ProfileParameters = 3;
constexpr int RadiusSteps = 48;
constexpr double LeastBlur = 1e-4;   // pixels^2
constexpr double LeastSquare = 1e-8; // of a gradient

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
  double periodError, const std::vector<std::string>& channels, const Eigen::VectorXd& error,
  Eigen::Index& next)
{
  const auto K = static_cast<Eigen::Index>(channels.size());
  const BandingSines sines = bandingSines(choice, model);
  const bool profile = isProfile(choice);
  const bool offset =
    choice.has(ImageParameter::RowOffset) || choice.has(ImageParameter::ColumnOffset);
  std::vector<GapParameter> parameters;
  parameters.push_back({ "period", sines.period, "pixels", profile ? 0.0 : periodError });
  for (Eigen::Index k = 0; k < K; ++k)
  {
    const std::string& channel = channels[static_cast<std::size_t>(k)];
    for (Eigen::Index n = 0; n < sines.amplitude.cols(); ++n)
    {
      const double amplitude = sines.amplitude(k, n);
      // The strength of a profile scales all of its sines.
      const double deviation = profile
        ? error[next + k] * amplitude / std::fmax(model.at(choice.terms.front().parameter, k), 1e-3)
        : std::hypot(error[next + k], error[next + K + k]) / std::sqrt(2.0);
      parameters.push_back({ withChannel("amplitude" + harmonicName(n), channel), amplitude,
        offset ? "white" : "1", deviation });
      parameters.push_back({ withChannel("start" + harmonicName(n), channel), sines.start(k, n),
        "cycle", std::fmin(deviation / std::fmax(amplitude, 1e-12) / TwoPi, 0.5) });
    }
  }
  next += profile ? K : 2 * K;
  return parameters;
}

// What a parameter's value and its error are multiplied by for the library.
double libraryScale(const ImageTerm& term, const FieldModel& model)
{
  const double square = std::pow(model.at(ImageParameter::GradientRight, 0), 2) +
    std::pow(model.at(ImageParameter::GradientDown, 0), 2);
  return term.scale == ImageScale::AlongSlope ? 1.0 / std::fmax(square, LeastSquare) : 1.0;
}

// The fraction and radius of the effect's own form that come nearest to free weights of the passes.
struct TailForm
{
  double fraction;
  double radius;
};

TailForm tailForm(const FieldModel& model)
{
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(TailPasses);
  for (int i = 0; i < FreePasses; ++i)
  {
    weight[i + 1] = model.at(surroundWeight(i), 0);
  }
  TailForm best{ 0.0, 0.0 };
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= RadiusSteps; ++step)
  {
    const double radius = std::exp2(6.0 * step / RadiusSteps); // 1 .. 64 pixels
    const Eigen::ArrayXd form = tailWeights(radius);
    const double fraction = (form * weight).sum() / form.square().sum();
    const double error = (weight - fraction * form).square().sum();
    if (error < least)
    {
      least = error;
      best = { fraction, radius };
    }
  }
  return best;
}

bool isFree(const FieldChoice& choice)
{
  return choice.terms.front().parameter == ImageParameter::SurroundFirst;
}
}

std::vector<FieldChoice> fieldChoices(const std::vector<std::string>& without)
{
  requireKnown(without);
  std::vector<FieldChoice> choices;
  for (const EffectDefinition& effect : effectLibrary())
  {
    for (const ImageForm& form : effect.imageForms)
    {
      if (std::find(without.begin(), without.end(), effect.name) == without.end())
      {
        choices.push_back({ &effect, form.form, form.terms });
      }
    }
  }
  // Of effects that do as well the exact ones come first.
  std::stable_partition(choices.begin(), choices.end(),
    [](const FieldChoice& choice) { return choice.has(EffectTrait::Exact); });
  return choices;
}

bool FieldChoice::has(ImageParameter parameter) const noexcept
{
  return std::any_of(terms.begin(), terms.end(),
    [parameter](const ImageTerm& term) { return term.parameter == parameter; });
}

bool isBanding(const FieldChoice& choice)
{
  const ImageParameter first = choice.terms.front().parameter;
  return first >= ImageParameter::RowSine && first <= ImageParameter::ColumnOffset;
}

bool isProfile(const FieldChoice& choice)
{
  return choice.terms.front().parameter >= ImageParameter::RowGain && isBanding(choice);
}

bool isOfRows(const FieldChoice& choice)
{
  return choice.form.rfind("row", 0) == 0;
}

bool compatible(const FieldSet& set, const FieldChoice& choice)
{
  for (const FieldChoice* other : set)
  {
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

Eigen::Index parameterCount(const FieldSet& set, Eigen::Index channels)
{
  Eigen::Index count = 0;
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
    {
      count += term.perChannel ? channels : 1;
    }
    count += isBanding(*choice) ? 1 : 0; // the period
    count += isProfile(*choice) ? ProfileParameters * channels : 0;
  }
  return count;
}

std::vector<GapParameter> fieldParameters(const FieldChoice& choice, const FieldModel& model,
  double periodError, const std::vector<std::string>& channels, const Eigen::VectorXd& error,
  Eigen::Index& next)
{
  std::vector<GapParameter> parameters;
  const auto K = static_cast<Eigen::Index>(channels.size());
  if (isBanding(choice))
  {
    return bandingParameters(choice, model, periodError, channels, error, next);
  }
  if (isFree(choice))
  {
    const TailForm form = tailForm(model);
    const Eigen::VectorXd errors = error.segment(next, FreePasses);
    parameters.push_back({ "fraction", form.fraction, "1", errors.norm() });
    parameters.push_back({ "radius", form.radius, "pixels",
      form.radius * errors.norm() / std::fmax(std::fabs(form.fraction), 1e-12) });
    next += FreePasses;
    return parameters;
  }
  for (const ImageTerm& term : choice.terms)
  {
    if (term.name.empty())
    {
      ++next;
      continue;
    }
    for (Eigen::Index k = 0; k < (term.perChannel ? K : 1); ++k)
    {
      const double scale = libraryScale(term, model);
      double value = scale * model.at(term.parameter, k);
      double deviation = scale * error[next++];
      if (term.scale == ImageScale::Squared)
      {
        value = std::sqrt(std::fmax(value, 0.0));
        deviation = value > 0.0 ? deviation / (2.0 * value) : std::sqrt(deviation);
      }
      parameters.push_back(
        { term.perChannel ? withChannel(term.name, channels[static_cast<std::size_t>(k)])
                          : term.name,
          value, term.unit, deviation });
    }
  }
  return parameters;
}

std::vector<CameraEffect> fieldCorrection(
  const FieldSet& set, const FieldModel& model, const std::vector<std::string>& channels)
{
  const auto K = static_cast<Eigen::Index>(channels.size());
  std::vector<CameraEffect> effects;
  for (const FieldChoice* choice : set)
  {
    CameraEffect effect = neutralEffect(choice->effect->name, channels, choice->form);
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
    if (isBanding(*choice))
    {
      const BandingSines sines = bandingSines(*choice, model);
      put("period", sines.period);
      for (Eigen::Index k = 0; k < K; ++k)
      {
        const std::string& channel = channels[static_cast<std::size_t>(k)];
        for (Eigen::Index n = 0; n < sines.amplitude.cols(); ++n)
        {
          put(withChannel("amplitude" + harmonicName(n), channel), sines.amplitude(k, n));
          put(withChannel("start" + harmonicName(n), channel), sines.start(k, n));
        }
      }
    }
    if (isFree(*choice))
    {
      const TailForm form = tailForm(model);
      put("fraction", form.fraction);
      put("radius", form.radius);
    }
    for (const ImageTerm& term : choice->terms)
    {
      for (Eigen::Index k = 0; k < (term.perChannel ? K : 1); ++k)
      {
        const double value = libraryScale(term, model) * model.at(term.parameter, k);
        const bool squared = term.scale == ImageScale::Squared;
        put(term.perChannel ? withChannel(term.name, channels[static_cast<std::size_t>(k)])
                            : term.name,
          squared ? (value > LeastBlur ? std::sqrt(value) : 0.0) : value);
      }
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

} // namespace msi

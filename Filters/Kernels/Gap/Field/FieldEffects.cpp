#include "Kernels/Gap/Field/FieldEffects.h"

#include "Kernels/Camera/Angle.h"
#include "Kernels/Gap/Field/FieldBanding.h"
#include "Kernels/Gap/Field/FieldTail.h"

#include <cmath>

namespace msi
{

namespace
{
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

bool isFree(const FieldChoice& choice)
{
  return choice.terms.front().parameter == ImageParameter::SurroundFirst;
}
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

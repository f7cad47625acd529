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
    case P::GradientBend:
      return { "bend", "1" };
    case P::Falloff:
      return { "falloff", "1" };
    case P::Fourth:
      return { "fourth", "1" };
    case P::Sixth:
      return { "sixth", "1" };
    case P::CenterX:
      return { "center_x", "half field" };
    case P::CenterY:
      return { "center_y", "half field" };
    case P::Square:
      return { "square", "1" };
    case P::Exponent:
      return { "exponent", "1" };
    case P::Compression:
      return { "compression", "1" };
    case P::ClipLevel:
      return { "level", "white" };
    case P::Retained:
      return { "retained", "1" };
    case P::Right:
      return { "right", "pixels" };
    case P::Down:
      return { "down", "pixels" };
    case P::Magnification:
      return { "magnification", "1" };
    case P::Rotation:
      return { "rotation", "degrees" };
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

// "", "_2", "_3"
std::string harmonicName(Eigen::Index n)
{
  return n == 0 ? std::string() : "_" + std::to_string(n + 1);
}

// Lines of stripes' parameters, errors from `next` on.
std::vector<GapParameter> bandingParameters(const FieldChoice& choice,
  const FieldSearchResult& found, const std::vector<std::string>& channels,
  const Eigen::VectorXd& error, Eigen::Index& next)
{
  const auto K = static_cast<Eigen::Index>(channels.size());
  const FieldModel& model = found.after.model;
  const BandingSines sines = bandingSines(choice, model);
  const bool profile = isProfile(choice);
  const bool offset = choice.form == "row_offsets" || choice.form == "column_offsets";
  std::vector<GapParameter> parameters;
  const FieldPeriod& period = isOfRows(choice) ? found.rows : found.columns;
  parameters.push_back({ "period", sines.period, "pixels", profile ? 0.0 : period.standardError });
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
double libraryScale(FieldParameter parameter, const FieldModel& model)
{
  const double square = std::pow(model.at(FieldParameter::GradientRight, 0), 2) +
    std::pow(model.at(FieldParameter::GradientDown, 0), 2);
  return parameter == FieldParameter::GradientBend ? 1.0 / std::fmax(square, LeastSquare) : 1.0;
}

bool isFree(const FieldChoice& choice)
{
  return choice.terms.front().parameter == FieldParameter::SurroundFirst;
}
}

std::string libraryForm(const FieldChoice& choice)
{
  return isFree(choice) ? "neighbours" : choice.form;
}

std::vector<GapParameter> fieldParameters(const FieldChoice& choice, const FieldSearchResult& found,
  const std::vector<std::string>& channels, const Eigen::VectorXd& error, Eigen::Index& next)
{
  const FieldModel& model = found.after.model;
  std::vector<GapParameter> parameters;
  const auto K = static_cast<Eigen::Index>(channels.size());
  if (choice.effect == "banding")
  {
    return bandingParameters(choice, found, channels, error, next);
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
  for (const FieldTerm& term : choice.terms)
  {
    if (term.parameter == FieldParameter::Clip)
    {
      ++next;
      continue;
    }
    const Named named = nameOf(term.parameter);
    for (Eigen::Index k = 0; k < (term.perChannel ? K : 1); ++k)
    {
      const double scale = libraryScale(term.parameter, model);
      double value = scale * model.at(term.parameter, k);
      double deviation = scale * error[next++];
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

std::vector<CameraEffect> fieldCorrection(
  const FieldSet& set, const FieldModel& model, const std::vector<std::string>& channels)
{
  const auto K = static_cast<Eigen::Index>(channels.size());
  std::vector<CameraEffect> effects;
  for (const FieldChoice* choice : set)
  {
    CameraEffect effect = neutralEffect(choice->effect, channels, libraryForm(*choice));
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
    for (const FieldTerm& term : choice->terms)
    {
      for (Eigen::Index k = 0; k < (term.perChannel ? K : 1); ++k)
      {
        const double value = libraryScale(term.parameter, model) * model.at(term.parameter, k);
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

#include "Kernels/Gap/Field/FieldEffects.h"

#include "Kernels/Gap/Field/FieldTail.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double TwoPi = 6.283185307179586;
constexpr double LeastBlur = 1e-4; // pixels^2

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

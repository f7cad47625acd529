#include "Kernels/Camera/Effects/BoundEffect.h"

#include "Kernels/Spectra/Reject.h"

namespace msi
{

namespace
{
constexpr double BoundTolerance = 0.01;
}

BoundEffect::BoundEffect(const CameraEffect& effect, const CameraModel& camera, int medium)
  : Definition(&requireEffect(effect.name))
  , Form(&requireForm(*Definition, effect.form))
  , Camera(&camera)
  , Values(effect.parameters)
  , Medium(medium)
  , Neutral(true)
{
  const bool needsMedium = Definition->need == EffectNeed::Medium;
  if (needsMedium && effect.medium.empty())
  {
    reject("the camera effect ", effect.name, " acts on one medium; name it");
  }
  if (!needsMedium && !effect.medium.empty())
  {
    reject("the camera effect ", effect.name, " acts on all media; '", effect.medium,
      "' cannot be its medium");
  }
  std::size_t expected = 0;
  for (const EffectParameter& parameter : Form->parameters)
  {
    expected += countOf(parameter);
  }
  if (Values.size() != expected)
  {
    reject("the camera effect ", effect.name, " in the form ", Form->name, " has ", expected,
      " parameters but ", Values.size(), " are given");
  }
  std::size_t i = 0;
  for (const EffectParameter& parameter : Form->parameters)
  {
    const double margin = BoundTolerance * (parameter.upper - parameter.lower);
    for (const std::size_t end = i + countOf(parameter); i < end; ++i)
    {
      if (!(Values[i] >= parameter.lower - margin && Values[i] <= parameter.upper + margin))
      {
        reject("the parameter ", effectParameters(effect, camera.channels())[i].name,
          " of the camera effect ", effect.name, " is ", Values[i], "; expected a value from ",
          parameter.lower, " to ", parameter.upper);
      }
      Neutral = Neutral && (parameter.secondary || Values[i] == parameter.neutral);
    }
  }
}

std::size_t BoundEffect::countOf(const EffectParameter& parameter) const noexcept
{
  return parameter.perChannel ? Camera->channels().size() : 1;
}

Eigen::Map<const Eigen::ArrayXd> BoundEffect::valuesOf(std::string_view parameter) const
{
  std::size_t offset = 0;
  for (const EffectParameter& candidate : Form->parameters)
  {
    const std::size_t count = countOf(candidate);
    if (candidate.name == parameter)
    {
      return { Values.data() + offset, static_cast<Eigen::Index>(count) };
    }
    offset += count;
  }
  reject("the form ", Form->name, " of ", Definition->name, " has no parameter ", parameter);
}

double BoundEffect::value(std::string_view parameter) const
{
  return valuesOf(parameter)[0];
}

Eigen::ArrayXd BoundEffect::perChannel(std::string_view parameter) const
{
  const auto values = valuesOf(parameter);
  return values.size() == 1
    ? Eigen::ArrayXd(Eigen::ArrayXd::Constant(Camera->channelCount(), values[0]))
    : Eigen::ArrayXd(values);
}

} // namespace msi

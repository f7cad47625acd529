#include "Kernels/Camera/Effects/EffectChain.h"

#include "Kernels/Camera/CameraResponse.h"
#include "Kernels/Camera/Effects/EffectEntry.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
[[noreturn]] void rejectTwice(const CameraEffect& effect)
{
  std::ostringstream message;
  message << "the camera effect " << effect.name << " is given twice";
  if (!effect.medium.empty())
  {
    message << " for medium '" << effect.medium << "'";
  }
  message << "; give it once";
  throw std::invalid_argument(message.str());
}
}

EffectChain::EffectChain(
  CameraModel camera, std::vector<CameraEffect> effects, bool whiteAfterEffects)
  : Camera(std::move(camera))
  , Effects(std::move(effects))
  , Responsivity(Camera.responsivity())
  , Dark(Camera.dark().array())
{
  // In the order of the library, whatever the order in which they were given.
  std::vector<const CameraEffect*> ordered;
  for (const CameraEffect& effect : Effects)
  {
    ordered.push_back(&effect);
  }
  std::stable_sort(ordered.begin(), ordered.end(),
    [](const CameraEffect* a, const CameraEffect* b)
    { return findEffect(a->name) < findEffect(b->name); });
  for (std::size_t i = 0; i < ordered.size(); ++i)
  {
    if (i > 0 && ordered[i]->name == ordered[i - 1]->name &&
      ordered[i]->medium == ordered[i - 1]->medium)
    {
      rejectTwice(*ordered[i]);
    }
    add(*ordered[i]);
  }
  if (whiteAfterEffects && Responsivity != Camera.responsivity())
  {
    balanceWhite();
  }
  const bool onImage = std::any_of(Active.begin(), Active.end(),
    [](const CameraEffect* effect)
    { return findEffect(effect->name)->stage == EffectStage::Image; });
  DarkInIntegral =
    OnIrradiance.empty() && BeforeDark.empty() && !VeilingGlare && !LocalStrayLight && !onImage;
  const Eigen::VectorXd dark =
    DarkInIntegral ? Camera.dark() : Eigen::VectorXd::Zero(Camera.channelCount());
  Integral = cameraResponse(Responsivity, dark);
}

void EffectChain::add(const CameraEffect& effect)
{
  const bool newMedium = !effect.medium.empty() && mediumNumber(effect.medium) < 0;
  const int medium = newMedium ? static_cast<int>(Media.size()) : mediumNumber(effect.medium);
  const BoundEffect bound(effect, Camera, medium);
  if (bound.isNeutral())
  {
    return;
  }
  if (newMedium)
  {
    Media.push_back(effect.medium);
  }
  Active.push_back(&effect);
  const EffectDefinition& definition = bound.definition();
  const EffectEntry& entry = entryOf(definition);
  NeedsPosition = NeedsPosition || definition.need == EffectNeed::Position;
  NeedsOrder = NeedsOrder || definition.need == EffectNeed::Order;
  if (entry.makeResponsivity != nullptr)
  {
    entry.makeResponsivity(bound)->apply(Responsivity);
  }
  if (entry.makeSurround != nullptr)
  {
    (definition.name == "veiling_glare" ? VeilingGlare : LocalStrayLight) =
      entry.makeSurround(bound);
  }
  if (entry.makeBlock != nullptr)
  {
    BlockOperators& place = definition.stage == EffectStage::Reflectance ? OnReflectance
      : definition.stage == EffectStage::Irradiance                      ? OnIrradiance
      : entry.afterDark                                                  ? AfterDark
                                                                         : BeforeDark;
    place.push_back(entry.makeBlock(bound));
  }
}

void EffectChain::balanceWhite()
{
  const Eigen::VectorXd nominal = Camera.whiteResponse();
  const Eigen::VectorXd real = Responsivity.rowwise().sum();
  for (Eigen::Index k = 0; k < real.size(); ++k)
  {
    if (!(real[k] > 0.0))
    {
      std::ostringstream message;
      message << "with its effects channel " << Camera.channels()[static_cast<std::size_t>(k)]
              << " answers a perfect white with " << real[k]
              << "; a white balance needs a value above zero";
      throw std::invalid_argument(message.str());
    }
  }
  Responsivity.array().colwise() *= nominal.array() / real.array();
}

int EffectChain::mediumNumber(const std::string& medium) const noexcept
{
  const auto found = std::find(Media.begin(), Media.end(), medium);
  return found == Media.end() ? -1 : static_cast<int>(found - Media.begin());
}

std::optional<BoundEffect> EffectChain::active(std::string_view name) const
{
  const auto found = std::find_if(Active.begin(), Active.end(),
    [name](const CameraEffect* effect) { return effect->name == name; });
  if (found == Active.end())
  {
    return std::nullopt;
  }
  return BoundEffect(**found, Camera, mediumNumber((*found)->medium));
}

NoiseGenerator EffectChain::noiseGenerator(CameraNoise noise, std::uint64_t seed) const
{
  const std::optional<BoundEffect> excess = active("excess_noise");
  if (!excess)
  {
    return { noise, seed };
  }
  if (excess->form().name == "added")
  {
    noise.read = std::hypot(noise.read, excess->value("added"));
    return { noise, seed };
  }
  return { noise, seed, excess->perChannel("factor") };
}

} // namespace msi

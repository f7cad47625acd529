#include "Kernels/Camera/Effects/EffectChain.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace msi
{

EffectChain::EffectChain(
  CameraModel camera, std::vector<CameraEffect> effects, bool whiteAfterEffects)
  : Camera(std::make_shared<const CameraModel>(std::move(camera)))
  , Effects(std::move(effects))
  , WhiteAfterEffects(whiteAfterEffects)
  , Dark(Camera->dark().array())
{
  build(nullptr);
}

EffectChain::EffectChain(
  const EffectChain& related, std::vector<CameraEffect> effects, bool whiteAfterEffects)
  : Camera(related.Camera)
  , Effects(std::move(effects))
  , WhiteAfterEffects(whiteAfterEffects)
  , Media(related.Media)
  , Dark(related.Dark)
{
  build(&related);
}

void EffectChain::build(const EffectChain* related)
{
  for (std::size_t e = 0; e < Effects.size(); ++e)
  {
    const Step* known = related != nullptr ? related->stepLike(Effects[e]) : nullptr;
    Steps.push_back(known != nullptr ? *known : bind(e));
    Steps.back().effect = e;
  }
  // In the order of the library, whatever the order in which they were given.
  std::stable_sort(Steps.begin(), Steps.end(),
    [](const Step& a, const Step& b)
    {
      return std::make_pair(&a.bound.definition(), !a.bound.form().has(FormTrait::BesideLine)) <
        std::make_pair(&b.bound.definition(), !b.bound.form().has(FormTrait::BesideLine));
    });
  requireOnce();
  for (const Step& step : Steps)
  {
    if (!step.bound.isNeutral())
    {
      place(step);
    }
  }
  const bool onImage = std::any_of(Steps.begin(), Steps.end(),
    [](const Step& step)
    { return !step.bound.isNeutral() && step.bound.definition().stage == EffectStage::Image; });
  DarkInIntegral =
    OnIrradiance.empty() && BeforeDark.empty() && !VeilingGlare && !LocalStrayLight && !onImage;

  if (related != nullptr && OnResponsivity == related->OnResponsivity &&
    WhiteAfterEffects == related->WhiteAfterEffects)
  {
    Responsivity = related->Responsivity;
    if (DarkInIntegral == related->DarkInIntegral)
    {
      Integral = related->Integral;
      return;
    }
  }
  else
  {
    auto responsivity = std::make_shared<Eigen::MatrixXd>(Camera->responsivity());
    for (const auto& step : OnResponsivity)
    {
      step->apply(*responsivity);
    }
    if (WhiteAfterEffects && *responsivity != Camera->responsivity())
    {
      balanceWhite(*responsivity);
    }
    Responsivity = std::move(responsivity);
  }
  const Eigen::VectorXd dark =
    DarkInIntegral ? Camera->dark() : Eigen::VectorXd::Zero(Camera->channelCount());
  Integral = std::make_shared<const AffineTransform>(cameraResponse(*Responsivity, dark));
}

EffectChain::Step EffectChain::bind(std::size_t effect)
{
  const std::string& name = Effects[effect].medium;
  const bool newMedium = !name.empty() && mediumNumber(name) < 0;
  const int medium = newMedium ? static_cast<int>(Media.size()) : mediumNumber(name);
  Step step{ effect, BoundEffect(Effects[effect], *Camera, medium), nullptr, nullptr, nullptr };
  if (step.bound.isNeutral())
  {
    return step;
  }
  if (newMedium)
  {
    Media.push_back(name);
  }
  const Effect& effectOperators = registered(step.bound.definition());
  if (effectOperators.makeResponsivity != nullptr)
  {
    step.onResponsivity = effectOperators.makeResponsivity(step.bound);
  }
  if (effectOperators.makeBlock != nullptr)
  {
    step.onBlock = effectOperators.makeBlock(step.bound);
  }
  if (effectOperators.makeStrayLight != nullptr)
  {
    step.strayLight =
      std::make_shared<const StrayLight>(effectOperators.makeStrayLight(step.bound));
  }
  return step;
}

const EffectChain::Step* EffectChain::stepLike(const CameraEffect& effect) const noexcept
{
  const auto found = std::find_if(Steps.begin(), Steps.end(),
    [&](const Step& step)
    {
      const CameraEffect& mine = Effects[step.effect];
      return mine.parameters == effect.parameters && mine.name == effect.name &&
        mine.form == effect.form && mine.medium == effect.medium;
    });
  return found == Steps.end() ? nullptr : &*found;
}

void EffectChain::requireOnce() const
{
  for (auto step = Steps.begin(); step != Steps.end(); ++step)
  {
    const CameraEffect& mine = Effects[step->effect];
    const bool twice = std::any_of(Steps.begin(), step,
      [&](const Step& other)
      {
        return &other.bound.definition() == &step->bound.definition() &&
          other.bound.form().has(FormTrait::BesideLine) ==
          step->bound.form().has(FormTrait::BesideLine) &&
          Effects[other.effect].medium == mine.medium;
      });
    if (twice)
    {
      reject("the camera effect ", mine.name, " is given twice",
        mine.medium.empty() ? "" : " for medium '" + mine.medium + "'", "; give it once");
    }
  }
}

void EffectChain::place(const Step& step)
{
  const EffectDefinition& definition = step.bound.definition();
  NeedsPosition = NeedsPosition || definition.need == EffectNeed::Position ||
    step.bound.form().has(FormTrait::OfField);
  NeedsOrder = NeedsOrder || definition.need == EffectNeed::Order;
  if (step.onResponsivity)
  {
    OnResponsivity.push_back(step.onResponsivity);
  }
  if (step.strayLight)
  {
    (registered(definition).surround == Surround::Scene ? VeilingGlare : LocalStrayLight) =
      step.strayLight;
  }
  if (step.onBlock)
  {
    BlockOperators& operators = definition.stage == EffectStage::Reflectance ? OnReflectance
      : definition.stage == EffectStage::Irradiance                          ? OnIrradiance
      : registered(definition).afterDark                                     ? AfterDark
                                                                             : BeforeDark;
    operators.push_back(step.onBlock);
  }
}

void EffectChain::balanceWhite(Eigen::MatrixXd& responsivity) const
{
  const Eigen::VectorXd nominal = Camera->whiteResponse();
  const Eigen::VectorXd real = responsivity.rowwise().sum();
  for (Eigen::Index k = 0; k < real.size(); ++k)
  {
    if (!(real[k] > 0.0))
    {
      reject("with its effects channel ", Camera->channels()[static_cast<std::size_t>(k)],
        " answers a perfect white with ", real[k], "; a white balance needs a value above zero");
    }
  }
  responsivity.array().colwise() *= nominal.array() / real.array();
}

std::vector<int> EffectChain::mediaReflectedOtherwise(const EffectChain& related) const
{
  std::vector<int> media;
  const auto addMissing = [&media](const EffectChain& here, const EffectChain& there)
  {
    for (const Step& step : here.Steps)
    {
      const auto& others = there.OnReflectance;
      if (step.bound.definition().stage == EffectStage::Reflectance && step.onBlock &&
        std::find(others.begin(), others.end(), step.onBlock) == others.end())
      {
        media.push_back(step.bound.medium());
      }
    }
  };
  addMissing(*this, related);
  addMissing(related, *this);
  return media;
}

bool EffectChain::integratesLike(const EffectChain& related) const noexcept
{
  return Integral == related.Integral;
}

bool EffectChain::illuminatesLike(const EffectChain& related) const noexcept
{
  return OnIrradiance == related.OnIrradiance && VeilingGlare == related.VeilingGlare &&
    LocalStrayLight == related.LocalStrayLight;
}

bool EffectChain::detectsLike(const EffectChain& related) const noexcept
{
  return BeforeDark == related.BeforeDark && AfterDark == related.AfterDark &&
    DarkInIntegral == related.DarkInIntegral;
}

int EffectChain::mediumNumber(const std::string& medium) const noexcept
{
  const auto found = std::find(Media.begin(), Media.end(), medium);
  return found == Media.end() ? -1 : static_cast<int>(found - Media.begin());
}

std::vector<BoundEffect> EffectChain::active() const
{
  std::vector<BoundEffect> bound;
  for (const Step& step : Steps)
  {
    if (!step.bound.isNeutral())
    {
      bound.push_back(step.bound);
    }
  }
  return bound;
}

NoiseGenerator EffectChain::noiseGenerator(CameraNoise noise, std::uint64_t seed) const
{
  for (const BoundEffect& effect : active())
  {
    if (effect.definition().stage == EffectStage::Noise)
    {
      if (effect.form().has(FormTrait::Adds))
      {
        noise.read = std::hypot(noise.read, effect.value("added"));
        return { noise, seed };
      }
      return { noise, seed, effect.perChannel("factor") };
    }
  }
  return { noise, seed };
}

} // namespace msi

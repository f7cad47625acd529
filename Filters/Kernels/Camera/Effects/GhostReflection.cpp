// Light that the lens reflects through the center of the image.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

namespace
{
ImagePlace throughCenter(const ImagePlace& pixel, const ImageExtent& extent)
{
  return { extent.width - 1 - pixel.x, extent.height - 1 - pixel.y };
}
}

Effect ghostReflection()
{
  const EffectParameter strength{ "strength", "1", 0.0, 0.0, 0.3, 0.01,
    "share of the light at the opposite place" };
  Effect effect;
  effect.definition = { "ghost_reflection", "Ghost reflection",
    "Detector and lens reflect a part of the light: a weak image appears on the opposite side of "
    "the center.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "common", "u(x, y) + strength u(-x, -y)", { strength } },
      { "per_channel", "the same with a strength of its own for each channel",
        { strength.ofChannels() } } },
    { "one bright spot off the center of a dark field" }, EffectTrait::None,
    { { "common", { imageTerm(0, strength) } },
      { "per_channel", { imageTerm(0, strength.ofChannels()) } } } };
  effect.onImage.lightFrom = throughCenter;
  static const ImageStep step = stepOfLight();
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi

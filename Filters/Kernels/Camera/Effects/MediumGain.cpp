// A medium that sends less light to the camera than to the spectrophotometer.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

Effect mediumGain()
{
  Effect effect;
  effect.definition = { "medium_gain", "Gain of one medium",
    "The camera's geometry sees less light from this medium than the spectrophotometer's.",
    EffectStage::Reflectance, EffectNeed::Medium,
    { { "gain", "gain r", { { "gain", "1", 1.0, 0.3, 2.0, 0.05, "factor on the reflectance" } } } },
    { "rotated sample" } };
  effect.makeBlock = [](const BoundEffect& bound)
  {
    return onMedium(
      bound, [](auto r, auto gain) { r *= gain; }, bound.value("gain"));
  };
  return effect;
}

} // namespace msi

// Light that strikes the surface again.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

Effect interreflection()
{
  Effect effect;
  effect.definition = { "interreflection", "Interreflection",
    "A share p of the light that leaves a point of the surface strikes the surface again.",
    EffectStage::Reflectance, EffectNeed::Medium,
    { { "cavity", "r (1 - p) / (1 - p r)",
      { { "probability", "1", 0.0, -0.8, 0.9, 0.05,
        "probability of a further reflection; negative where the spectrophotometer saw more of "
        "them" } } } },
    { "flat and folded sample" } };
  effect.makeBlock = [](const BoundEffect& bound)
  {
    return onMedium(
      bound, [](auto r, auto p) { r = (1 - p) * r / (1 - p * r); }, bound.value("probability"));
  };
  return effect;
}

} // namespace msi

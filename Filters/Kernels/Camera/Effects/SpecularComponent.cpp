// Surface reflection that only one of the two instruments collects.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

Effect specularComponent()
{
  const EffectParameter pedestal{ "pedestal", "1", 0.0, -0.2, 0.2, 0.01,
    "specular reflection that the camera sees beyond the spectrophotometer" };
  Effect effect;
  effect.definition = { "specular_component", "Specular component",
    "Surface reflection that only one of the two instruments collects.", EffectStage::Reflectance,
    EffectNeed::Medium,
    { { "pedestal", "r + pedestal", { pedestal } },
      { "body", "(1 - pedestal) r + pedestal: what the surface reflects does not reach the body",
        { pedestal } } },
    { "specular included and excluded measurement, black glossy tile" } };
  effect.makeBlock = [](const BoundEffect& bound)
  {
    const double added = bound.value("pedestal");
    return onMedium(
      bound, [](auto r, auto body, auto surface) { r = body * r + surface; },
      bound.form().name == "body" ? 1.0 - added : 1.0, added);
  };
  return effect;
}

} // namespace msi

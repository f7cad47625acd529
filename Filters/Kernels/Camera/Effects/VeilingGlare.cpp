// Light scattered in the lens over the whole field.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/StrayLight.h"

namespace msi
{

namespace
{
EffectParameter glare(bool perChannel)
{
  return { "fraction", "1", 0.0, 0.0, 0.5, 0.01, "share of the scene's mean signal", perChannel };
}
}

Effect veilingGlare()
{
  using P = ImageParameter;
  Effect effect;
  effect.definition = { "veiling_glare", "Veiling glare",
    "Light scattered in the lens covers the whole field in proportion to the scene's mean.",
    EffectStage::Irradiance, EffectNeed::Nothing,
    { { "common", "u + fraction (mean of the scene)", { glare(false) } },
      { "conserving", "u + fraction (mean of the scene - u)", { glare(false) } },
      { "per_channel", "u + fraction (mean of the scene), a fraction for each channel",
        { glare(true) } } },
    "black trap, second scene", EffectTrait::None,
    { { "common", { imageTerm(P::Glare, glare(false)) } },
      { "conserving", { imageTerm(P::ConservingGlare, glare(false)) } },
      { "per_channel", { imageTerm(P::Glare, glare(true)) } } } };
  effect.makeSurround = makeSurroundOperator<StrayLight>;
  return effect;
}

} // namespace msi

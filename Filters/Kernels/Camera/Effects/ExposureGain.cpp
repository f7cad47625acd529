// All channels brighter or darker.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/Gain.h"

namespace msi
{

Effect exposureGain()
{
  const EffectParameter gain{ "gain", "1", 1.0, 0.2, 5.0, 0.03, "factor on every channel" };
  Effect effect;
  effect.definition = { "exposure_gain", "Exposure gain",
    "All channels brighter or darker: exposure time, aperture, lamp, white tile.",
    EffectStage::Detector, EffectNeed::Nothing, { { "common", "gain u", { gain } } },
    Captures::RepeatedWhite, EffectTrait::Exact | EffectTrait::CommonGain,
    { { "common", { imageTerm(0, gain) } } } };
  effect.makeBlock = makeGain;
  effect.onImage.steps = { &gainStep() };
  return effect;
}

} // namespace msi

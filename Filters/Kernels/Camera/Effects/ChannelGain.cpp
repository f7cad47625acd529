// A gain of each channel.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/Gain.h"

namespace msi
{

Effect channelGain()
{
  const EffectParameter gain{ "gain", "1", 1.0, 0.2, 5.0, 0.03, "factor on the channel", true };
  Effect effect;
  effect.definition = { "channel_gain", "Channel gain",
    "Every channel has an error of its own in exposure or white balance.", EffectStage::Detector,
    EffectNeed::Nothing, { { "per_channel", "gain_k u_k", { gain }, {} } }, { "grey ramp", 5.0 },
    EffectTrait::Exact, { { "per_channel", { imageTerm(0, gain) } } } };
  effect.makeBlock = makeGain;
  effect.onImage.steps = { &gainStep() };
  return effect;
}

} // namespace msi

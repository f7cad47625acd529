// More scatter than the noise model says.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

Effect excessNoise()
{
  const EffectParameter factor{ "factor", "1", 1.0, 0.1, 1000.0, 0.3,
    "factor on the standard deviation" };
  Effect effect;
  effect.definition = { "excess_noise", "Excess noise",
    "More scatter between repeats than the noise model says; the mean does not change.",
    EffectStage::Noise, EffectNeed::Nothing,
    { { "factor", "standard deviation x factor", { factor } },
      { "per_channel", "standard deviation x factor of the channel", { factor.ofChannels() } },
      { "added", "variance + added^2",
        { { "added", "white", 0.0, 0.0, 0.2, 0.002, "further standard deviation" } }, {},
        FormTrait::Adds } },
    { "more repeats", 2.0 } };
  return effect;
}

} // namespace msi

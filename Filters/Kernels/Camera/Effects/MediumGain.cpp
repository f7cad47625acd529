// A medium that sends less light to the camera than to the spectrophotometer.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MediumOperator.h"

namespace msi
{

namespace
{
class MediumGain : public MediumOperator<MediumGain>
{
public:
  explicit MediumGain(const BoundEffect& effect)
    : MediumOperator(effect)
    , Gain(effect.value("gain"))
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    r *= static_cast<Scalar>(Gain);
  }

private:
  double Gain;
};
}

Effect mediumGain()
{
  Effect effect;
  effect.definition = { "medium_gain", "Gain of one medium",
    "The camera's geometry sees less light from this medium than the spectrophotometer's.",
    EffectStage::Reflectance, EffectNeed::Medium,
    { { "gain", "gain r", { { "gain", "1", 1.0, 0.3, 2.0, 0.05, "factor on the reflectance" } } } },
    { "rotated sample" } };
  effect.makeBlock = makeBlockOperator<MediumGain>;
  return effect;
}

} // namespace msi

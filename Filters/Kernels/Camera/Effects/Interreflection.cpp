// Light that strikes the surface again.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MediumOperator.h"

namespace msi
{

namespace
{
class Interreflection : public MediumOperator<Interreflection>
{
public:
  explicit Interreflection(const BoundEffect& effect)
    : MediumOperator(effect)
    , Probability(effect.value("probability"))
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    const auto p = static_cast<Scalar>(Probability);
    r = (Scalar(1) - p) * r / (Scalar(1) - p * r);
  }

private:
  double Probability;
};
}

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
  effect.makeBlock = makeBlockOperator<Interreflection>;
  return effect;
}

} // namespace msi

// Surface reflection that only one of the two instruments collects.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MediumOperator.h"

namespace msi
{

namespace
{
class SpecularComponent : public MediumOperator<SpecularComponent>
{
public:
  explicit SpecularComponent(const BoundEffect& effect)
    : MediumOperator(effect)
    , Pedestal(effect.value("pedestal"))
    , Scale(effect.form().name == "body" ? 1.0 - Pedestal : 1.0)
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    r = static_cast<Scalar>(Scale) * r + static_cast<Scalar>(Pedestal);
  }

private:
  double Pedestal;
  double Scale;
};
}

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
  effect.makeBlock = makeBlockOperator<SpecularComponent>;
  return effect;
}

} // namespace msi

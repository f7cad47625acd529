// More light on one side of the field than on the other.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/FieldOperator.h"

#include <vector>

namespace msi
{

namespace
{
class IlluminationGradient : public FieldOperator<IlluminationGradient>
{
public:
  explicit IlluminationGradient(const BoundEffect& effect)
    : Right(effect.value("right"))
    , Down(effect.value("down"))
    , Bend(effect.form().name == "bent" ? effect.value("bend") : 0.0)
  {
  }
  double factor(double x, double y) const noexcept
  {
    const double plane = Right * x + Down * y;
    return 1.0 + plane + Bend * plane * plane;
  }

private:
  double Right;
  double Down;
  double Bend;
};
}

Effect illuminationGradient()
{
  using P = ImageParameter;
  const EffectParameter right{ "right", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in x" };
  const EffectParameter down{ "down", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in y" };
  const EffectParameter bend{ "bend", "1", 0.0, -10.0, 10.0, 1.0,
    "1 / 2 for an exponential, 3 / 4 for the inverse square of a distance", false, true };
  const std::vector<ImageTerm> plane = { imageTerm(P::GradientRight, right),
    imageTerm(P::GradientDown, down) };
  std::vector<ImageTerm> bent = plane;
  // Of the square of the place along the slope, whatever the slope is.
  bent.push_back(
    { P::GradientBend, false, -0.3, 0.3, 0.03, bend.name, bend.unit, ImageScale::AlongSlope });
  Effect effect;
  effect.definition = { "illumination_gradient", "Illumination gradient",
    "More light on one side of the field than on the other.", EffectStage::Irradiance,
    EffectNeed::Position,
    { { "plane", "u (1 + right x + down y), x and y from -1 to 1 over the field", { right, down } },
      { "bent", "u (1 + s + bend s^2), s = right x + down y: a lamp that is near",
        { right, down, bend } } },
    "flat field", EffectTrait::None, { { "plane", plane }, { "bent", bent } } };
  effect.makeBlock = makeBlockOperator<IlluminationGradient>;
  return effect;
}

} // namespace msi

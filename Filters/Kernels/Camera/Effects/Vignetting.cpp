// A lens that passes less light off its axis.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/FieldOperator.h"

#include <cmath>
#include <vector>

namespace msi
{

namespace
{
class Vignetting : public FieldOperator<Vignetting>
{
public:
  explicit Vignetting(const BoundEffect& effect)
    : CosineFourth(effect.form().name == "cos4")
    , Polynomial(effect.form().name == "polynomial")
    , Strength(CosineFourth ? std::pow(effect.value("tangent"), 2) : effect.value("falloff"))
    , Fourth(Polynomial ? effect.value("fourth") : 0.0)
    , Sixth(Polynomial ? effect.value("sixth") : 0.0)
    , CenterX(effect.value("center_x"))
    , CenterY(effect.value("center_y"))
  {
  }
  double factor(double x, double y) const noexcept
  {
    const double radius2 = (x - CenterX) * (x - CenterX) + (y - CenterY) * (y - CenterY);
    if (CosineFourth)
    {
      const double secant2 = 1.0 + Strength * radius2;
      return 1.0 / (secant2 * secant2);
    }
    if (Polynomial)
    {
      const double factor = 1.0 - radius2 * (Strength + radius2 * (Fourth + radius2 * Sixth));
      return std::fmax(factor, 0.0);
    }
    return 1.0 - Strength * radius2;
  }

private:
  bool CosineFourth;
  bool Polynomial;
  double Strength;
  double Fourth;
  double Sixth;
  double CenterX;
  double CenterY;
};
}

Effect vignetting()
{
  using P = ImageParameter;
  const EffectParameter falloff{ "falloff", "1", 0.0, -0.45, 0.45, 0.03, "loss at rho = 1" };
  const auto order = [](const char* name, const char* meaning) {
    return EffectParameter{ name, "1", 0.0, -1.5, 1.5, 0.03, meaning };
  };
  const std::vector<EffectParameter> orders = { order("falloff",
                                                  "loss at rho = 1 that grows with rho^2"),
    order("fourth", "loss at rho = 1 that grows with rho^4"),
    order("sixth", "loss at rho = 1 that grows with rho^6") };
  const auto axis = [](const char* name) {
    return EffectParameter{ name, "half field", 0.0, -1.0, 1.0, 0.2, "optical axis", false, true };
  };
  const std::vector<EffectParameter> center = { axis("center_x"), axis("center_y") };
  const ImageTerm quadratic = imageTerm(P::Falloff, falloff);
  const ImageTerm steep = imageTerm(P::Falloff, orders[0]);
  const ImageTerm fourth = imageTerm(P::Fourth, orders[1]);
  const ImageTerm sixth = imageTerm(P::Sixth, orders[2]);
  const ImageTerm centerX = imageTerm(P::CenterX, center[0]);
  const ImageTerm centerY = imageTerm(P::CenterY, center[1]);
  Effect effect;
  effect.definition = { "vignetting", "Vignetting", "The lens passes less light off its axis.",
    EffectStage::Irradiance, EffectNeed::Position,
    { { "quadratic", "u (1 - falloff rho^2), rho = 1 at half the longer side of the field",
        { falloff, center[0], center[1] } },
      { "cos4", "u / (1 + tangent^2 rho^2)^2, the cosine-fourth law",
        { { "tangent", "1", 0.0, 0.0, 1.0, 0.1, "tangent of the field angle at rho = 1" },
          center[0], center[1] },
        { { 0.2, 0.0, 0.0 } } },
      { "polynomial", "u (1 - falloff rho^2 - fourth rho^4 - sixth rho^6), not below zero",
        { orders[0], orders[1], orders[2], center[0], center[1] } } },
    "chart rotated by 180 degrees", EffectTrait::None,
    { { "quadratic", { quadratic } }, { "quadratic", { quadratic, centerX, centerY } },
      { "polynomial", { steep, fourth, sixth } },
      { "polynomial", { steep, fourth, sixth, centerX, centerY } } } };
  effect.makeBlock = makeBlockOperator<Vignetting>;
  return effect;
}

} // namespace msi

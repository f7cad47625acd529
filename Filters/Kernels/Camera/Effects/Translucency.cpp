// Light that spreads sideways in the medium and leaves outside the measured spot.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MediumOperator.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double MiddleWavelength = 550.0;

class Translucency : public MediumOperator<Translucency>
{
public:
  explicit Translucency(const BoundEffect& effect)
    : MediumOperator(effect)
    , Loss(effect.value("loss") *
        (effect.camera().wavelengths().vector().array() / MiddleWavelength)
          .pow(effect.value("exponent")))
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    r = r / (Scalar(1) + Loss.as<Scalar>() * r);
  }

private:
  ChannelValues Loss;
};
}

Effect translucency()
{
  Effect effect;
  effect.definition = { "translucency", "Translucency",
    "Light spreads sideways in the medium and leaves outside the measured spot: more of it the "
    "less "
    "is absorbed and the longer the wavelength.",
    EffectStage::Reflectance, EffectNeed::Medium,
    { { "power", "r / (1 + loss (wavelength / 550 nm)^exponent r)",
      { { "loss", "1", 0.0, -0.4, 2.0, 0.05, "loss at 550 nm for a reflectance of one" },
        { "exponent", "1", 2.0, 1.0, 10.0, 1.0, "growth with the wavelength", false, true } } } },
    { "layers over black and white backing" } };
  effect.makeBlock = makeBlockOperator<Translucency>;
  return effect;
}

} // namespace msi

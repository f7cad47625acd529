// Light that spreads sideways in the medium and leaves outside the measured spot.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/Passbands.h"

namespace msi
{

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
  effect.makeBlock = [](const BoundEffect& bound)
  {
    const Eigen::ArrayXd wavelength = bound.camera().wavelengths().vector();
    const ChannelValues losses(
      bound.value("loss") * (wavelength / MiddleWavelength).pow(bound.value("exponent")));
    return onMedium(
      bound, [](auto r, const auto& loss) { r = r / (1 + loss * r); }, losses);
  };
  return effect;
}

} // namespace msi

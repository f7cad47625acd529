// A lamp whose spectrum is not the one of the model.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/Passbands.h"

#include <cmath>

namespace msi
{

namespace
{
class IlluminantDrift : public ResponsivityOperator
{
public:
  explicit IlluminantDrift(const BoundEffect& effect)
  {
    const Eigen::ArrayXd x = gridPosition(effect.camera().wavelengths());
    if (effect.form().name == "band")
    {
      const Eigen::ArrayXd z =
        (effect.camera().wavelengths().vector().array() - effect.value("center")) /
        effect.value("width");
      Factor = 1.0 + effect.value("change") * (-0.5 * z.square()).exp();
      return;
    }
    const bool smooth = effect.form().name == "smooth";
    Factor = legendre(x, effect.value("tilt"), smooth ? effect.value("curvature") : 0.0,
      smooth ? effect.value("twist") : 0.0)
               .exp();
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    responsivity.array().rowwise() *= Factor.transpose();
  }

private:
  Eigen::ArrayXd Factor;
};
}

Effect illuminantDrift()
{
  const EffectParameter tilt{ "tilt", "1", 0.0, -2.0, 2.0, 0.1,
    "natural logarithm of the change at the long end; minus that at the short end" };
  Effect effect;
  effect.definition = { "illuminant_drift", "Illuminant drift",
    "The lamp's spectrum is not the one of the model: aged, another voltage, another lamp.",
    EffectStage::Responsivity, EffectNeed::Nothing,
    { { "tilt", "M exp(tilt x), x = -1..1 over the grid", { tilt } },
      { "smooth", "M exp(tilt P1(x) + curvature P2(x) + twist P3(x)), Legendre polynomials",
        { tilt, { "curvature", "1", 0.0, -2.0, 2.0, 0.1, "weight of P2" },
          { "twist", "1", 0.0, -2.0, 2.0, 0.1, "weight of P3" } } },
      { "band", "M (1 + change exp(-(wavelength - center)^2 / (2 width^2)))",
        { { "change", "1", 0.0, -0.9, 3.0, 0.1, "change of the lamp at the band's middle" },
          { "center", "nm", 560.0, 300.0, 1100.0, 60.0, "middle of the band", false, true },
          { "width", "nm", 50.0, 25.0, 150.0, 15.0, "standard deviation of the band", false,
            true } },
        { { 0.05, 440.0, 30.0 }, { 0.05, 500.0, 40.0 }, { 0.05, 560.0, 50.0 },
          { 0.05, 620.0, 40.0 }, { 0.05, 680.0, 40.0 } } } },
    "lamp spectrum, white tile", EffectTrait::SpectralGain };
  effect.makeResponsivity = makeResponsivityOperator<IlluminantDrift>;
  return effect;
}

} // namespace msi

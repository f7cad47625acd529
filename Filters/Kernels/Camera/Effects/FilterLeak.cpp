// Transmittance outside the passband.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/Passbands.h"

#include <vector>

namespace msi
{

namespace
{
class FilterLeak : public ResponsivityOperator
{
public:
  explicit FilterLeak(const BoundEffect& effect)
    : Fraction(effect.perChannel("fraction"))
    , White(effect.camera().whiteResponse().array())
  {
    const Eigen::ArrayXd x = gridPosition(effect.camera().wavelengths());
    Spectrum = (1.0 + effect.value("tilt") * x) *
      legendre(x, 0.0, effect.value("bend"), effect.value("twist")).exp();
    Spectrum /= Spectrum.sum();
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    responsivity += (Fraction * White).matrix() * Spectrum.matrix().transpose();
  }

private:
  Eigen::ArrayXd Fraction;
  Eigen::ArrayXd White;
  Eigen::ArrayXd Spectrum;
};
}

Effect filterLeak()
{
  const EffectParameter fraction{ "fraction", "1", 0.0, 0.0, 0.5, 0.01,
    "response to white through the leak over that through the passband" };
  const auto leak = [](const EffectParameter& share)
  {
    return std::vector<EffectParameter>{ share,
      { "tilt", "1", 0.0, -1.0, 1.0, 0.5, "-1 only short waves leak, 1 only long ones", false,
        true },
      { "bend", "1", 0.0, -4.0, 4.0, 1.0,
        "curvature of the leak's logarithm, weight of P2: 4 only the ends of the grid leak", false,
        true },
      { "twist", "1", 0.0, -4.0, 4.0, 1.0,
        "further curvature of the leak's logarithm: weight of P3", false, true } };
  };
  const std::vector<std::vector<double>> starts{ { 0.01, 0.0, 0.0, 0.0 }, { 0.01, 0.9, 0.0, 0.0 },
    { 0.01, -0.9, 0.0, 0.0 }, { 0.01, 0.0, 2.0, 0.0 } };
  Effect effect;
  effect.definition = { "filter_leak", "Filter leak",
    "Transmittance outside the passband: even over the grid, tilted or bent.",
    EffectStage::Responsivity, EffectNeed::Nothing,
    { { "common", "M + fraction x (response to white) x spectrum", leak(fraction), starts },
      { "per_channel", "the same with a fraction of its own for each channel",
        leak(fraction.ofLight()), starts } },
    { "long-pass tile" } };
  effect.makeResponsivity = makeResponsivityOperator<FilterLeak>;
  return effect;
}

} // namespace msi

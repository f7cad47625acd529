// A brightener in the medium.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MediumOperator.h"

#include <cmath>
#include <vector>

namespace msi
{

namespace
{
class Fluorescence : public MediumOperator<Fluorescence>
{
public:
  explicit Fluorescence(const BoundEffect& effect)
    : MediumOperator(effect)
    , Offset(effect.form().name == "uncoloured" || effect.form().name == "absorbed" ? 1.0 : 0.0)
    , Slope(effect.form().name == "uncoloured" ? 0.0
          : effect.form().name == "absorbed"   ? -1.0
                                               : 1.0)
  {
    const Eigen::ArrayXd distance =
      (effect.camera().wavelengths().vector().array() - effect.value("peak")) /
      effect.value("width");
    Emission = ChannelValues(effect.value("yield") * (-0.5 * distance.square()).exp());
    const WavelengthGrid& grid = effect.camera().wavelengths();
    ExcitedBands = 1;
    while (ExcitedBands < grid.size() && grid[ExcitedBands] <= LongestExcitation)
    {
      ++ExcitedBands;
    }
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    // A plain loop: the order of the sum must not depend on the column's alignment.
    Scalar sum = 0;
    for (Eigen::Index j = 0; j < ExcitedBands; ++j)
    {
      sum += r[j];
    }
    const Scalar excitation = static_cast<Scalar>(Offset) +
      static_cast<Scalar>(Slope) * sum / static_cast<Scalar>(ExcitedBands);
    r += Emission.as<Scalar>() * excitation;
  }

private:
  static constexpr double LongestExcitation = 420.0;
  double Offset;
  double Slope;
  ChannelValues Emission;
  Eigen::Index ExcitedBands;
};
}

Effect fluorescence()
{
  const std::vector<EffectParameter> emission = { { "yield", "1", 0.0, -0.5, 1.0, 0.02,
                                                    "emission at its peak for full excitation" },
    { "peak", "nm", 440.0, 420.0, 480.0, 10.0, "wavelength of the strongest emission", false,
      true },
    { "width", "nm", 18.0, 8.0, 40.0, 5.0, "standard deviation of the emission", false, true } };
  Effect effect;
  effect.definition = { "fluorescence", "Fluorescence",
    "A brightener in the medium turns light below 420 nm into light around 440 nm.",
    EffectStage::Reflectance, EffectNeed::Medium,
    { { "through_colorant",
        "r + yield E r_x; r_x is the mean reflectance up to 420 nm, the part that reaches the "
        "brightener",
        emission },
      { "uncoloured", "r + yield E", emission },
      { "absorbed", "r + yield E (1 - r_x)", emission } },
    { "UV-cut filter" } };
  effect.makeBlock = makeBlockOperator<Fluorescence>;
  return effect;
}

} // namespace msi

// A brightener in the medium.
#include "Kernels/Camera/Effects/Effect.h"

#include <memory>
#include <string>
#include <vector>

namespace msi
{

namespace
{
constexpr double LongestExcitation = 420.0; // nm

std::unique_ptr<BlockOperator> makeFluorescence(const BoundEffect& effect)
{
  const std::string& form = effect.form().name;
  const double offset = form == "uncoloured" || form == "absorbed" ? 1.0 : 0.0;
  const double slope = form == "uncoloured" ? 0.0 : form == "absorbed" ? -1.0 : 1.0;
  const WavelengthGrid& grid = effect.camera().wavelengths();
  const Eigen::ArrayXd distance =
    (grid.vector().array() - effect.value("peak")) / effect.value("width");
  const ChannelValues emissions(effect.value("yield") * (-0.5 * distance.square()).exp());
  Eigen::Index excited = 1;
  while (excited < grid.size() && grid[excited] <= LongestExcitation)
  {
    ++excited;
  }
  const auto emit = [excited](auto r, const auto& emission, auto constant, auto factor)
  {
    // A plain loop: the order of the sum must not depend on the column's alignment.
    using Scalar = decltype(factor);
    Scalar sum = 0;
    for (Eigen::Index j = 0; j < excited; ++j)
    {
      sum += r[j];
    }
    r += emission * (constant + factor * sum / static_cast<Scalar>(excited));
  };
  return onMedium(effect, emit, emissions, offset, slope);
}
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
  effect.makeBlock = makeFluorescence;
  return effect;
}

} // namespace msi

// Passbands at other wavelengths than nominal.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MovedSpectrum.h"
#include "Kernels/Camera/Effects/Passbands.h"

namespace msi
{

namespace
{
constexpr const char* OwnLevels = "own_levels";

// A passband that moves over a smooth reflectance is a reflectance that moves under the passband. That side
// can be interpolated; passbands and lamp lines are too narrow for it.
class FilterShift : public ResponsivityOperator
{
public:
  explicit FilterShift(const BoundEffect& effect)
    : Grid(effect.camera().wavelengths())
    , Moved(Grid)
    , Shift(effect.perChannel("shift"))
    , Sampled(effect.form().name == "sampled")
  {
    const bool ownLevels = effect.form().name == OwnLevels;
    if (ownLevels || effect.form().name == "linear")
    {
      Shift +=
        effect.value("slope") * (passbandCentroids(effect.camera()) - MiddleWavelength) / 100.0;
    }
    if (ownLevels)
    {
      Level = (Shift * effect.perChannel("level")).exp();
    }
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    for (Eigen::Index k = 0; k < responsivity.rows(); ++k)
    {
      if (k > 0 && Shift[k] == Shift[k - 1])
      {
        continue; // done together with the row before
      }
      const Eigen::Index count = rowsAlike(k);
      auto rows = responsivity.middleRows(k, count);
      if (Level.size() > 0)
      {
        rows.array().colwise() *= Level.segment(k, count);
      }
      if (Sampled)
      {
        const Eigen::MatrixXd moved = Moved.operation(Grid.vector().array() - Shift[k]);
        rows = (rows * moved.transpose()).eval();
      }
      else
      {
        const Eigen::ArrayXd at = Grid.vector().array() + Shift[k];
        for (Eigen::Index i = 0; i < count; ++i)
        {
          rows.row(i) = Moved.weighted(rows.row(i).transpose().array(), at);
        }
      }
    }
  }

private:
  Eigen::Index rowsAlike(Eigen::Index first) const
  {
    Eigen::Index last = first + 1;
    while (last < Shift.size() && Shift[last] == Shift[first])
    {
      ++last;
    }
    return last - first;
  }

  WavelengthGrid Grid;
  MovedSpectrum Moved;
  Eigen::ArrayXd Shift;
  Eigen::ArrayXd Level; // of each channel; empty: none changes
  bool Sampled;
};

std::unique_ptr<ResponsivityOperator> makeShift(const BoundEffect& effect)
{
  if (goesByNeighbours(effect))
  {
    return makePassbandsOfNeighbours(effect, effect.value("shift"), 0.0);
  }
  return std::make_unique<FilterShift>(effect);
}
}

Effect filterShift()
{
  const auto shift = [](bool perChannel)
  {
    return EffectParameter{ "shift", "nm", 0.0, -25.0, 25.0, 2.0, "towards longer wavelengths",
      perChannel };
  };
  const auto slope = [](bool secondary)
  {
    return EffectParameter{ "slope", "nm per 100 nm", 0.0, -15.0, 15.0, 1.0, "growth of the shift",
      false, secondary };
  };
  Effect effect;
  effect.definition = { "filter_shift", "Filter shift",
    "Passbands at other wavelengths than nominal: maker's tolerance, oblique incidence, "
    "temperature.",
    EffectStage::Responsivity, EffectNeed::Nothing,
    { { "common", "M(wavelength - shift), response to white kept", { shift(false) }, {},
        FormTrait::KeepsWhite },
      { "of_neighbours",
        "between the passbands of the neighbouring channels, response to white kept: for a "
        "camera that was fitted to samples",
        { shift(false) }, {}, FormTrait::KeepsWhite },
      { "sampled",
        "the curve itself is moved on its grid: what leaves at an end is lost to the response "
        "to white",
        { shift(false) } },
      { "linear", "shift + slope (centroid - 550 nm) / 100 nm", { shift(false), slope(false) }, {},
        FormTrait::KeepsWhite },
      { OwnLevels,
        "as linear, times exp(shift level): in a light with lines each channel becomes brighter or "
        "darker as its passband moves",
        { shift(false),
          EffectParameter{ "level", "1 per nm", 0.0, -0.05, 0.05, 0.01,
            "change of the channel's response to white, natural logarithm" }
            .ofLight(),
          slope(true) },
        { { 1.0, 0.0, 0.0 }, { -1.0, 0.0, 0.0 } } },
      { "per_channel", "a shift of its own for each channel", { shift(true) }, {},
        FormTrait::KeepsWhite } },
    { "chart at several field positions, lamp spectrum" } };
  effect.makeResponsivity = makeShift;
  return effect;
}

} // namespace msi

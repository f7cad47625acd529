// Passbands wider or narrower than the nominal ones.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MovedSpectrum.h"
#include "Kernels/Camera/Effects/Passbands.h"

#include <algorithm>
#include <limits>

namespace msi
{

namespace
{
constexpr double LeastFactor = 0.2; // of a width that changes from channel to channel
constexpr const char* OwnMiddles = "own_middles";
// Natural logarithm per nm^2: as much as nearly all lamps do to a Gaussian filter of 10 nm and more.
constexpr double MostLevel = 0.002;

// Of passbands as if they were Gaussians, by their squares, so that little far from a passband counts for nothing; nm^2. No less than
// that of one step.
Eigen::ArrayXd variancesOf(const CameraModel& camera, const Eigen::ArrayXd& middles)
{
  const WavelengthGrid& grid = camera.wavelengths();
  const Eigen::RowVectorXd wavelength = grid.vector().transpose();
  const Eigen::ArrayXXd weight = camera.responsivity().array().square();
  const Eigen::ArrayXXd distance =
    wavelength.replicate(weight.rows(), 1).array().colwise() - middles;
  const double step =
    (grid.back() - grid.front()) / static_cast<double>(std::max<Eigen::Index>(grid.size() - 1, 1));
  return (2.0 * (weight * distance.square()).rowwise().sum() /
    weight.rowwise().sum().max(std::numeric_limits<double>::min()))
    .max(step * step / 12.0);
}

class FilterBandwidth : public ResponsivityOperator
{
public:
  explicit FilterBandwidth(const BoundEffect& effect)
    : Grid(effect.camera().wavelengths())
    , Moved(Grid)
    , Factor(effect.perChannel("factor"))
    , Center(passbandCentroids(effect.camera()))
    , Gain(Eigen::ArrayXd::Ones(Factor.size()))
  {
    if (effect.form().name == "fixed_peak")
    {
      Gain = Factor;
    }
    if (effect.form().name == OwnMiddles)
    {
      const Eigen::ArrayXd variance = variancesOf(effect.camera(), Center);
      Factor = (Factor.square() + effect.value("added_variance") / variance)
                 .max(LeastFactor * LeastFactor)
                 .sqrt();
      Center += effect.perChannel("middle");
      Gain = ((Factor.square() - 1.0) * variance * effect.perChannel("level")).exp();
    }
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    const Eigen::ArrayXd wavelength = Grid.vector().array();
    for (Eigen::Index k = 0; k < responsivity.rows(); ++k)
    {
      const Eigen::ArrayXd at = Center[k] + Factor[k] * (wavelength - Center[k]);
      responsivity.row(k) = Moved.weighted(Gain[k] * responsivity.row(k).transpose().array(), at);
    }
  }

private:
  WavelengthGrid Grid;
  MovedSpectrum Moved;
  Eigen::ArrayXd Factor;
  Eigen::ArrayXd Center;
  Eigen::ArrayXd Gain;
};

std::unique_ptr<ResponsivityOperator> makeBandwidth(const BoundEffect& effect)
{
  if (goesByNeighbours(effect))
  {
    return makePassbandsOfNeighbours(effect, 0.0, effect.value("added_variance"));
  }
  return std::make_unique<FilterBandwidth>(effect);
}
}

Effect filterBandwidth()
{
  const EffectParameter factor{ "factor", "1", 1.0, 0.3, 3.0, 0.1,
    "real width of the passband over the nominal one" };
  Effect effect;
  effect.definition = { "filter_bandwidth", "Filter bandwidth",
    "Passbands wider or narrower than the nominal ones, about their centroids.",
    EffectStage::Responsivity, EffectNeed::Nothing,
    { { "common", "M(c + (wavelength - c) / factor), response to white kept", { factor }, {},
        FormTrait::KeepsWhite },
      { "of_neighbours",
        "exp(added_variance / 2 D) M, D: the second derivative over the neighbouring channels, "
        "response to white kept, at an end of the grid what would go beyond stays: for a camera "
        "that was fitted to samples",
        { { "added_variance", "nm^2", 0.0, -200.0, 800.0, 15.0,
          "variance of the real passband beyond the nominal one" } },
        {}, FormTrait::KeepsWhite },
      { "per_channel", "the same with a factor of its own for each channel",
        { factor.ofChannels() }, {}, FormTrait::KeepsWhite },
      { "fixed_peak", "the same with the peak kept: the response to white grows with the width",
        { factor }, {}, FormTrait::Brightens },
      { OwnMiddles,
        "M(m + (wavelength - m) / factor) exp(level x added variance), m and level of each "
        "passband: a light with lines moves the centroid away from the middle, and a wider "
        "passband becomes brighter or darker in it",
        { factor,
          EffectParameter{ "middle", "nm", 0.0, -30.0, 30.0, 10.0,
            "from the centroid to the middle of the passband" }
            .ofLight(),
          EffectParameter{ "level", "1 per nm^2", 0.0, -MostLevel, MostLevel, 0.0005,
            "change of the channel's response to white, natural logarithm" }
            .ofLight(),
          { "added_variance", "nm^2", 0.0, -200.0, 800.0, 30.0,
            "the same for all passbands, beyond what the factor does", false, true } },
        { { 1.15, 0.0, 0.0, 0.0 }, { 0.85, 0.0, 0.0, 0.0 } }, FormTrait::Brightens } },
    Captures::Monochromator };
  effect.makeResponsivity = makeBandwidth;
  return effect;
}

} // namespace msi

// Lamp and filters that are not what the model says.
#include "Kernels/Camera/Effects/EffectEntry.h"
#include "Kernels/Camera/Effects/MovedSpectrum.h"
#include "Kernels/Camera/Effects/PassbandCenter.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double MiddleWavelength = 550.0;
constexpr double LeastFactor = 0.2; // of a width that changes from channel to channel

// Wavelengths mapped so that the grid is [-1, 1].
Eigen::ArrayXd position(const WavelengthGrid& grid, const Eigen::ArrayXd& wavelength)
{
  if (grid.size() < 2)
  {
    return Eigen::ArrayXd::Zero(wavelength.size());
  }
  return 2.0 * (wavelength - grid.front()) / (grid.back() - grid.front()) - 1.0;
}

Eigen::ArrayXd position(const WavelengthGrid& grid)
{
  return position(grid, grid.vector().array());
}

// Sum of the Legendre polynomials P1 to P3.
Eigen::ArrayXd legendre(const Eigen::ArrayXd& x, double first, double second, double third)
{
  return first * x + (second * (1.5 * x.square() - 0.5) + third * (2.5 * x.cube() - 1.5 * x));
}

// Channel centroids; the middle of the grid where a row has no weight.
Eigen::ArrayXd centers(const CameraModel& camera)
{
  const double middle = 0.5 * (camera.wavelengths().front() + camera.wavelengths().back());
  return camera.centroids().array().unaryExpr(
    [&](double center)
    {
      const bool inside =
        center >= camera.wavelengths().front() && center <= camera.wavelengths().back();
      return inside ? center : middle;
    });
}

class IlluminantDrift : public ResponsivityOperator
{
public:
  explicit IlluminantDrift(const BoundEffect& effect)
  {
    const Eigen::ArrayXd x = position(effect.camera().wavelengths());
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
    if (effect.form().name == "linear")
    {
      Shift += effect.value("slope") * (centers(effect.camera()) - MiddleWavelength) / 100.0;
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
  bool Sampled;
};

class FilterBandwidth : public ResponsivityOperator
{
public:
  explicit FilterBandwidth(const BoundEffect& effect)
    : Grid(effect.camera().wavelengths())
    , Moved(Grid)
    , Factor(effect.perChannel("factor"))
    , Center(centers(effect.camera()))
    , FixedPeak(effect.form().name == "fixed_peak")
  {
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    const Eigen::ArrayXd wavelength = Grid.vector().array();
    for (Eigen::Index k = 0; k < responsivity.rows(); ++k)
    {
      const Eigen::ArrayXd at = Center[k] + Factor[k] * (wavelength - Center[k]);
      const double gain = FixedPeak ? Factor[k] : 1.0;
      responsivity.row(k) = Moved.weighted(gain * responsivity.row(k).transpose().array(), at);
    }
  }

private:
  WavelengthGrid Grid;
  MovedSpectrum Moved;
  Eigen::ArrayXd Factor;
  Eigen::ArrayXd Center;
  bool FixedPeak;
};

// Passbands that move or widen under a light that stays: they take on its slope, their brightness changes with it, and
// they end where it ends. As with the plain shift, the smooth sides, reflectance and light, are read elsewhere:
// integral of light(w) passband(c + (w - c - shift) / f) r(w) = f x integral of M(v) light(w) / light(v) r(w),
// w = c + f (v - c) + shift.
class PassbandsInLight : public ResponsivityOperator
{
public:
  explicit PassbandsInLight(const BoundEffect& effect)
    : Grid(effect.camera().wavelengths())
    , Moved(Grid)
    , Slope(effect.value("slope"))
    , Bend(effect.value("bend"))
    , Twist(effect.value("twist"))
  {
    const bool widens = effect.definition().name == "filter_bandwidth";
    const Eigen::Index channels = effect.camera().channelCount();
    const Eigen::ArrayXd growth =
      1.0 + effect.value("growth") * (centers(effect.camera()) - MiddleWavelength) / 100.0;
    Factor = Eigen::ArrayXd::Ones(channels);
    Shift = Eigen::ArrayXd::Zero(channels);
    if (widens)
    {
      Factor = (1.0 + (effect.perChannel("factor") - 1.0) * growth).max(LeastFactor);
    }
    else
    {
      Shift = effect.perChannel("shift") * growth;
    }
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    const Eigen::ArrayXd wavelength = Grid.vector().array();
    const Eigen::ArrayXd known = logLight(wavelength);
    for (Eigen::Index k = 0; k < responsivity.rows(); ++k)
    {
      const Eigen::ArrayXd row = responsivity.row(k).transpose().array();
      const double center = Factor[k] == 1.0 ? 0.0 : passbandCenter(Grid, row, known);
      const Eigen::ArrayXd at = center + Factor[k] * (wavelength - center) + Shift[k];
      const double factor = Factor[k];
      const Eigen::ArrayXd inside =
        at.unaryExpr([this, factor](double w) { return insidePart(w, factor); });
      const Eigen::ArrayXd lit = Factor[k] * row * inside * (logLight(at) - known).exp();
      responsivity.row(k) = Moved.weighted(lit, at);
    }
  }

private:
  Eigen::ArrayXd logLight(const Eigen::ArrayXd& wavelength) const
  {
    return legendre(position(Grid, wavelength).cwiseMax(-1.2).cwiseMin(1.2), Slope, Bend, Twist);
  }
  // The light ends half a step beyond the grid: the part of a step, `factor` times as wide, that is before that.
  double insidePart(double wavelength, double factor) const
  {
    const double first = Grid[1] - Grid[0];
    const double last = Grid.back() - Grid[Grid.size() - 2];
    const double below = (wavelength - Grid.front() + 0.5 * first) / (factor * first);
    const double above = (Grid.back() + 0.5 * last - wavelength) / (factor * last);
    const double part = std::clamp(std::fmin(below, above) + 0.5, 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part); // without a kink where nothing moves
  }

  WavelengthGrid Grid;
  MovedSpectrum Moved;
  Eigen::ArrayXd Factor;
  Eigen::ArrayXd Shift;
  double Slope;
  double Bend;
  double Twist;
};

template <typename Plain>
std::unique_ptr<ResponsivityOperator> makeInLightOr(const BoundEffect& effect)
{
  if (effect.form().name == "in_light" && effect.camera().wavelengths().size() > 2)
  {
    return std::make_unique<PassbandsInLight>(effect);
  }
  return std::make_unique<Plain>(effect);
}

class FilterLeak : public ResponsivityOperator
{
public:
  explicit FilterLeak(const BoundEffect& effect)
    : Fraction(effect.perChannel("fraction"))
    , White(effect.camera().whiteResponse().array())
  {
    const Eigen::ArrayXd x = position(effect.camera().wavelengths());
    Spectrum = (1.0 + effect.value("tilt") * x) / static_cast<double>(x.size());
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

std::vector<EffectEntry> responsivityEffects()
{
  const auto shift = [](bool perChannel)
  {
    return EffectParameter{ "shift", "nm", 0.0, -25.0, 25.0, 2.0, "towards longer wavelengths",
      perChannel };
  };
  const auto factor = [](bool perChannel)
  {
    return EffectParameter{ "factor", "1", 1.0, 0.3, 3.0, 0.1,
      "real width of the passband over the nominal one", perChannel };
  };
  // Of the light's logarithm: ln(light) = slope P1(x) + bend P2(x).
  const EffectParameter slope{ "slope", "1", 0.0, -4.0, 4.0, 0.5,
    "natural logarithm of the light at the long end over that at the short end, halved", false,
    true };
  const EffectParameter bend{ "bend", "1", 0.0, -4.0, 4.0, 0.5,
    "curvature of the light's logarithm: weight of P2", false, true };
  const EffectParameter twist{ "twist", "1", 0.0, -4.0, 4.0, 0.5,
    "further curvature of the light's logarithm: weight of P3", false, true };
  const EffectParameter growth{ "growth", "1 per 100 nm", 0.0, -2.0, 2.0, 0.2,
    "relative growth of the change with the distance of the centroid from 550 nm", false, true };
  const auto leak = [](bool perChannel)
  {
    return std::vector<EffectParameter>{
      { "fraction", "1", 0.0, 0.0, 0.5, 0.01,
        "response to white through the leak over that through the passband", perChannel },
      { "tilt", "1", 0.0, -1.0, 1.0, 0.5, "-1 only short waves leak, 1 only long ones", false,
        true }
    };
  };
  const EffectParameter tilt{ "tilt", "1", 0.0, -2.0, 2.0, 0.1,
    "natural logarithm of the change at the long end; minus that at the short end" };
  return {
    { { "filter_bandwidth", "Filter bandwidth",
        "Passbands wider or narrower than the nominal ones, about their centroids.",
        EffectStage::Responsivity, EffectNeed::Nothing,
        { { "common", "M(c + (wavelength - c) / factor), response to white kept", { factor(false) },
            {}, true },
          { "per_channel", "the same with a factor of its own for each channel", { factor(true) },
            {}, true },
          { "fixed_peak", "the same with the peak kept: the response to white grows with the width",
            { factor(false) } },
          { "in_light",
            "light x passband(c + (wavelength - c) / factor), c the passband's middle; the light "
            "stays, ln(light) = slope P1(x) + bend P2(x) + twist P3(x), none beyond the grid",
            { factor(false), growth, slope, bend, twist },
            { { 1.1, 0.0, 0.0, 0.0, 0.0 }, { 1.1, 0.0, 1.0, 0.0, 0.0 },
              { 1.1, 0.0, -1.0, 0.0, 0.0 } } } } },
      makeInLightOr<FilterBandwidth> },
    { { "filter_shift", "Filter shift",
        "Passbands at other wavelengths than nominal: maker's tolerance, oblique incidence, "
        "temperature.",
        EffectStage::Responsivity, EffectNeed::Nothing,
        { { "common", "M(wavelength - shift), response to white kept", { shift(false) }, {}, true },
          { "sampled",
            "the curve itself is moved on its grid: what leaves at an end is lost to the response "
            "to white",
            { shift(false) } },
          { "linear", "shift + slope (centroid - 550 nm) / 100 nm",
            { shift(false),
              { "slope", "nm per 100 nm", 0.0, -15.0, 15.0, 1.0, "growth of the shift" } },
            {}, true },
          { "in_light",
            "light x passband(wavelength - shift); the light stays, ln(light) = slope P1(x) + bend "
            "P2(x) + twist P3(x), none beyond the grid",
            { shift(false), growth, slope, bend, twist },
            { { 1.0, 0.0, 0.0, 0.0, 0.0 }, { 1.0, 0.0, 1.0, 0.0, 0.0 },
              { 1.0, 0.0, -1.0, 0.0, 0.0 } } },
          { "per_channel", "a shift of its own for each channel", { shift(true) }, {}, true } } },
      makeInLightOr<FilterShift> },
    { { "filter_leak", "Filter leak",
        "Transmittance outside the passband, even over the grid or tilted.",
        EffectStage::Responsivity, EffectNeed::Nothing,
        { { "common", "M + fraction x (response to white) x spectrum", leak(false) },
          { "per_channel", "the same with a fraction of its own for each channel", leak(true) } } },
      makeResponsivityOperator<FilterLeak> },
    { { "illuminant_drift", "Illuminant drift",
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
              { 0.05, 620.0, 40.0 }, { 0.05, 680.0, 40.0 } } } } },
      makeResponsivityOperator<IlluminantDrift> },
  };
}

} // namespace msi

#include "Kernels/Camera/Effects/Passbands.h"

#include "Kernels/Camera/Effects/PassbandCenter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace msi
{

namespace
{
// Passbands that move or widen under a light that stays: they take on its slope, their brightness changes with it, and
// they end where it ends. As with the plain shift, the smooth sides, reflectance and light, are read elsewhere:
// integral of light(w) passband(c + (w - c - shift) / f) r(w) = f x integral of M(v) light(w) / light(v) r(w),
// w = c + f (v - c) + shift.
class PassbandsInLight : public ResponsivityOperator
{
public:
  PassbandsInLight(
    const BoundEffect& effect, const Eigen::ArrayXd& shift, const Eigen::ArrayXd& factor)
    : Grid(effect.camera().wavelengths())
    , Moved(Grid)
    , Factor(factor)
    , Shift(shift)
    , Slope(effect.value("slope"))
    , Bend(effect.value("bend"))
    , Twist(effect.value("twist"))
  {
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
    return legendre(
      gridPosition(Grid, wavelength).cwiseMax(-1.2).cwiseMin(1.2), Slope, Bend, Twist);
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

class PassbandsOfNeighbours : public ResponsivityOperator
{
public:
  PassbandsOfNeighbours(
    const WavelengthGrid& grid, const Eigen::ArrayXd& centers, double shift, double variance)
    : Change(Eigen::MatrixXd::Identity(centers.size(), centers.size()))
  {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(centers.size()));
    std::iota(order.begin(), order.end(), Eigen::Index(0));
    std::stable_sort(order.begin(), order.end(),
      [&centers](Eigen::Index a, Eigen::Index b) { return centers[a] < centers[b]; });
    for (std::size_t n = 0; n < order.size() && order.size() > 2; ++n)
    {
      const std::size_t first = std::min(n > 0 ? n - 1 : 0, order.size() - 3);
      const double at = centers[order[n]] + shift;
      // At an end where the grid has no room for a further neighbour, what would go beyond stays.
      const std::size_t inner = n == 0 ? 1 : n - 1;
      const double step = std::fabs(centers[order[inner]] - centers[order[n]]);
      const bool atEnd = (n == 0 && centers[order[n]] - step < grid.front()) ||
        (n + 1 == order.size() && centers[order[n]] + step > grid.back());
      const double curved = atEnd ? 0.0 : variance;
      Eigen::RowVector3d weight;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const double own = centers[order[first + i]];
        const double one = centers[order[first + (i + 1) % 3]];
        const double other = centers[order[first + (i + 2) % 3]];
        const double area = (own - one) * (own - other);
        weight[static_cast<Eigen::Index>(i)] = ((at - one) * (at - other) + curved) / area;
      }
      if (weight.allFinite())
      {
        Change.row(order[n]).setZero();
        for (std::size_t i = 0; i < 3; ++i)
        {
          Change(order[n], order[first + i]) = weight[static_cast<Eigen::Index>(i)];
        }
        if (atEnd)
        {
          const double exchanged = 0.5 * variance / (step * step);
          Change(order[n], order[n]) -= exchanged;
          Change(order[n], order[inner]) += exchanged;
        }
      }
    }
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    const Eigen::VectorXd white = responsivity.rowwise().sum();
    if ((white.array() > 0.0).all())
    {
      responsivity =
        white.asDiagonal() * (Change * (white.cwiseInverse().asDiagonal() * responsivity));
    }
  }

private:
  Eigen::MatrixXd Change;
};

}

std::unique_ptr<ResponsivityOperator> makePassbandsOfNeighbours(
  const BoundEffect& effect, double shift, double variance)
{
  return std::make_unique<PassbandsOfNeighbours>(
    effect.camera().wavelengths(), passbandCentroids(effect.camera()), shift, variance);
}

bool goesByNeighbours(const BoundEffect& effect)
{
  return effect.form().name == "of_neighbours";
}

Eigen::ArrayXd gridPosition(const WavelengthGrid& grid, const Eigen::ArrayXd& wavelength)
{
  if (grid.size() < 2)
  {
    return Eigen::ArrayXd::Zero(wavelength.size());
  }
  return 2.0 * (wavelength - grid.front()) / (grid.back() - grid.front()) - 1.0;
}

Eigen::ArrayXd gridPosition(const WavelengthGrid& grid)
{
  return gridPosition(grid, grid.vector().array());
}

Eigen::ArrayXd legendre(const Eigen::ArrayXd& x, double first, double second, double third)
{
  return first * x + (second * (1.5 * x.square() - 0.5) + third * (2.5 * x.cube() - 1.5 * x));
}

Eigen::ArrayXd passbandCentroids(const CameraModel& camera)
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

Eigen::ArrayXd passbandVariances(const CameraModel& camera, const Eigen::ArrayXd& middles)
{
  const Eigen::RowVectorXd wavelength = camera.wavelengths().vector().transpose();
  const Eigen::ArrayXXd weight = camera.responsivity().array().square();
  const Eigen::ArrayXXd distance =
    wavelength.replicate(weight.rows(), 1).array().colwise() - middles;
  const double step = (camera.wavelengths().back() - camera.wavelengths().front()) /
    static_cast<double>(std::max<Eigen::Index>(wavelength.size() - 1, 1));
  return (2.0 * (weight * distance.square()).rowwise().sum() /
    weight.rowwise().sum().max(std::numeric_limits<double>::min()))
    .max(step * step / 12.0);
}

std::unique_ptr<ResponsivityOperator> makePassbandsInLight(
  const BoundEffect& effect, const Eigen::ArrayXd& shift, const Eigen::ArrayXd& factor)
{
  return std::make_unique<PassbandsInLight>(effect, shift, factor);
}

bool movesInLight(const BoundEffect& effect)
{
  return effect.form().name == "in_light" && effect.camera().wavelengths().size() > 2;
}

Eigen::ArrayXd growthOf(const BoundEffect& effect)
{
  return 1.0 +
    effect.value("growth") * (passbandCentroids(effect.camera()) - MiddleWavelength) / 100.0;
}

EffectParameter growthParameter()
{
  return { "growth", "1 per 100 nm", 0.0, -2.0, 2.0, 0.2,
    "relative growth of the change with the distance of the centroid from 550 nm", false, true };
}

EffectForm inLightForm(
  const char* meaning, const EffectParameter& primary, double size, unsigned traits)
{
  // Of the light's logarithm: ln(light) = slope P1(x) + bend P2(x) + twist P3(x).
  const EffectParameter slope{ "slope", "1", 0.0, -4.0, 4.0, 0.5,
    "natural logarithm of the light at the long end over that at the short end, halved", false,
    true };
  const EffectParameter bend{ "bend", "1", 0.0, -4.0, 4.0, 0.5,
    "curvature of the light's logarithm: weight of P2", false, true };
  const EffectParameter twist{ "twist", "1", 0.0, -4.0, 4.0, 0.5,
    "further curvature of the light's logarithm: weight of P3", false, true };
  return { "in_light", meaning, { primary, growthParameter(), slope, bend, twist },
    { { size, 0.0, 0.0, 0.0, 0.0 }, { size, 0.0, 1.0, 0.0, 0.0 }, { size, 0.0, -1.0, 0.0, 0.0 } },
    traits };
}

} // namespace msi

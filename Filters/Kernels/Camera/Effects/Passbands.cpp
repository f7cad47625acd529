#include "Kernels/Camera/Effects/Passbands.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace msi
{

namespace
{
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

Eigen::ArrayXd gridPosition(const WavelengthGrid& grid)
{
  const Eigen::ArrayXd wavelength = grid.vector().array();
  if (grid.size() < 2)
  {
    return Eigen::ArrayXd::Zero(wavelength.size());
  }
  return 2.0 * (wavelength - grid.front()) / (grid.back() - grid.front()) - 1.0;
}

Eigen::ArrayXd legendre(const Eigen::ArrayXd& x, double first, double second, double third)
{
  return first * x + (second * (1.5 * x.square() - 0.5) + third * (2.5 * x.cube() - 1.5 * x));
}

EffectParameter followingLight(EffectParameter parameter)
{
  parameter.followsLight = true;
  return parameter;
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

} // namespace msi

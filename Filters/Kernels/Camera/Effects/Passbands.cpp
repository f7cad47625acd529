#include "Kernels/Camera/Effects/Passbands.h"

#include <unsupported/Eigen/MatrixFunctions>

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
    Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(centers.size(), centers.size());
    std::vector<Eigen::Index> order(static_cast<std::size_t>(centers.size()));
    std::iota(order.begin(), order.end(), Eigen::Index(0));
    std::stable_sort(order.begin(), order.end(),
      [&centers](Eigen::Index a, Eigen::Index b) { return centers[a] < centers[b]; });
    for (std::size_t n = 0; n < order.size() && order.size() > 2; ++n)
    {
      const Eigen::Index own = order[n];
      const std::size_t first = std::min(n > 0 ? n - 1 : 0, order.size() - 3);
      const double at = centers[own] + shift;
      Eigen::RowVectorXd moved = Eigen::RowVectorXd::Zero(centers.size());
      Eigen::RowVectorXd curved = moved;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const Eigen::Index node = order[first + i];
        const double one = centers[order[first + (i + 1) % 3]];
        const double other = centers[order[first + (i + 2) % 3]];
        const double area = (centers[node] - one) * (centers[node] - other);
        moved[node] = (at - one) * (at - other) / area;
        curved[node] = 2.0 / area;
      }
      // At an end where the grid has no room for a further neighbour, what would go beyond stays.
      const Eigen::Index inner = order[n == 0 ? 1 : n - 1];
      const double step = std::fabs(centers[inner] - centers[own]);
      if ((n == 0 && centers[own] - step < grid.front()) ||
        (n + 1 == order.size() && centers[own] + step > grid.back()))
      {
        curved.setZero();
        curved[inner] = 1.0 / (step * step);
        curved[own] = -curved[inner];
      }
      if (moved.allFinite() && curved.allFinite())
      {
        Change.row(own) = moved;
        curvature.row(own) = curved;
      }
    }
    if (variance != 0.0)
    {
      Change = (0.5 * variance * curvature).exp() * Change;
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

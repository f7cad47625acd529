#include "Kernels/Camera/Effects/PassbandCenter.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double UpperPart = 0.4; // of the passband's peak
}

double passbandCenter(
  const WavelengthGrid& grid, const Eigen::ArrayXd& responsivity, const Eigen::ArrayXd& logLight)
{
  const Eigen::Index count = grid.size();
  if (count < 3 || !(responsivity > 0.0).any())
  {
    return 0.5 * (grid.front() + grid.back());
  }
  const Eigen::ArrayXd relative = responsivity * (logLight.mean() - logLight).exp();
  Eigen::Index peak = 0;
  const double highest = relative.maxCoeff(&peak);
  Eigen::Index first = peak;
  Eigen::Index last = peak;
  while (first > 0 && relative[first - 1] > UpperPart * highest)
  {
    --first;
  }
  while (last + 1 < count && relative[last + 1] > UpperPart * highest)
  {
    ++last;
  }
  if (last - first < 2)
  {
    first = std::clamp<Eigen::Index>(peak - 1, 0, count - 3);
    last = first + 2;
  }
  const double scale = 0.5 * (grid[last] - grid[first]);
  const double middle = 0.5 * (grid[last] + grid[first]);
  // Weighted by the values, and scaled to -1..1: so few powers that normal equations lose nothing that matters.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (Eigen::Index i = first; i <= last; ++i)
  {
    const double value = relative[i] / highest;
    const double x = (grid[i] - middle) / scale;
    const Eigen::Vector3d row(value, value * x, value * x * x);
    normal += row * row.transpose();
    gradient += value * std::log(std::fmax(value, 1e-9)) * row;
  }
  const Eigen::Vector3d parabola = normal.ldlt().solve(gradient);
  if (!(parabola[2] < 0.0))
  {
    return grid[peak];
  }
  return middle + scale * std::clamp(-0.5 * parabola[1] / parabola[2], -2.0, 2.0);
}

} // namespace msi

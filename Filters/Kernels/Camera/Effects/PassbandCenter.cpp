#include "Kernels/Camera/Effects/PassbandCenter.h"

#include <Eigen/QR>

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
  const Eigen::Index points = last - first + 1;
  const double scale = 0.5 * (grid[last] - grid[first]);
  const double middle = 0.5 * (grid[last] + grid[first]);
  Eigen::MatrixXd columns(points, 3);
  Eigen::VectorXd logarithm(points);
  for (Eigen::Index i = 0; i < points; ++i)
  {
    const double value = relative[first + i] / highest;
    const double x = (grid[first + i] - middle) / scale;
    columns.row(i) << value, value * x, value * x * x;
    logarithm[i] = value * std::log(std::fmax(value, 1e-9));
  }
  const Eigen::Vector3d parabola = columns.colPivHouseholderQr().solve(logarithm);
  if (!(parabola[2] < 0.0))
  {
    return grid[peak];
  }
  return middle + scale * std::clamp(-0.5 * parabola[1] / parabola[2], -2.0, 2.0);
}

} // namespace msi

#include "Kernels/Spectra/Interpolation.h"

#include "Kernels/Spectra/Reject.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr double SameWavelength = 1e-6;
constexpr Eigen::Index LagrangeNodes = 4;
constexpr Eigen::Index SpragueLeast = 6;
constexpr Eigen::Index SplineLeast = 4;

// Where a wavelength lies: in interval [index, index + 1] of the grid, at a fraction of it.
struct Position
{
  Eigen::Index index;
  double fraction;
};

Position locate(const WavelengthGrid& grid, double wavelength) noexcept
{
  if (!(wavelength > grid.front()) || grid.size() == 1)
  {
    return { 0, 0.0 };
  }
  if (wavelength >= grid.back())
  {
    return { grid.size() - 2, 1.0 };
  }
  const auto& values = grid.values();
  const auto above = std::upper_bound(values.begin(), values.end(), wavelength);
  const Eigen::Index index = (above - values.begin()) - 1;
  return { index, (wavelength - grid[index]) / (grid[index + 1] - grid[index]) };
}

Eigen::MatrixXd linearMatrix(const WavelengthGrid& from, const WavelengthGrid& to)
{
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(to.size(), from.size());
  for (Eigen::Index i = 0; i < to.size(); ++i)
  {
    const Position at = locate(from, to[i]);
    matrix(i, at.index) += 1.0 - at.fraction;
    if (at.fraction > 0.0)
    {
      matrix(i, at.index + 1) += at.fraction;
    }
  }
  return matrix;
}

Eigen::MatrixXd lagrangeMatrix(const WavelengthGrid& from, const WavelengthGrid& to)
{
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(to.size(), from.size());
  const Eigen::Index nodes = std::min<Eigen::Index>(LagrangeNodes, from.size());
  for (Eigen::Index i = 0; i < to.size(); ++i)
  {
    const Eigen::Index interval = locate(from, to[i]).index;
    const Eigen::Index first = std::clamp<Eigen::Index>(interval - 1, 0, from.size() - nodes);
    const double wavelength = std::clamp(to[i], from.front(), from.back());
    for (Eigen::Index node = first; node < first + nodes; ++node)
    {
      double weight = 1.0;
      for (Eigen::Index other = first; other < first + nodes; ++other)
      {
        if (other != node)
        {
          weight *= (wavelength - from[other]) / (from[node] - from[other]);
        }
      }
      matrix(i, node) = weight;
    }
  }
  return matrix;
}

// The two values that CIE 167:2005 adds beyond an end, from the six values nearest to it.
constexpr std::array<std::array<double, 6>, 2> SpragueBoundary{ {
  { 884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0 }, // two steps beyond
  { 508.0, -540.0, 488.0, -367.0, 144.0, -24.0 },      // one step beyond
} };
constexpr double SpragueBoundaryDivisor = 209.0;

// Coefficient a of fraction^a, by rows, on the values at steps -2..3 around the interval.
constexpr std::array<std::array<double, 6>, 6> SpragueCoefficients{ {
  { 0.0, 0.0, 24.0, 0.0, 0.0, 0.0 },
  { 2.0, -16.0, 0.0, 16.0, -2.0, 0.0 },
  { -1.0, 16.0, -30.0, 16.0, -1.0, 0.0 },
  { -9.0, 39.0, -70.0, 66.0, -33.0, 7.0 },
  { 13.0, -64.0, 126.0, -124.0, 61.0, -12.0 },
  { -5.0, 25.0, -50.0, 50.0, -25.0, 5.0 },
} };
constexpr double SpragueDivisor = 24.0;

// The weight that the value at `index`, which may lie one or two steps beyond an end, hands on to
// the values of the grid.
void addSpragueValue(Eigen::MatrixXd& matrix, Eigen::Index row, Eigen::Index index, double weight)
{
  const Eigen::Index size = matrix.cols();
  if (index >= 0 && index < size)
  {
    matrix(row, index) += weight;
    return;
  }
  const bool below = index < 0;
  const Eigen::Index steps = below ? -index : index - size + 1;
  const auto& boundary = SpragueBoundary[steps == 2 ? 0 : 1];
  for (Eigen::Index k = 0; k < SpragueLeast; ++k)
  {
    matrix(row, below ? k : size - 1 - k) +=
      weight * boundary[static_cast<std::size_t>(k)] / SpragueBoundaryDivisor;
  }
}

Eigen::MatrixXd spragueMatrix(const WavelengthGrid& from, const WavelengthGrid& to)
{
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(to.size(), from.size());
  for (Eigen::Index i = 0; i < to.size(); ++i)
  {
    const Position at = locate(from, to[i]);
    for (Eigen::Index k = 0; k < SpragueLeast; ++k)
    {
      double weight = 0.0;
      for (std::size_t power = SpragueCoefficients.size(); power-- > 0;)
      {
        weight = weight * at.fraction + SpragueCoefficients[power][static_cast<std::size_t>(k)];
      }
      if (weight != 0.0)
      {
        addSpragueValue(matrix, i, at.index - 2 + k, weight / SpragueDivisor);
      }
    }
  }
  return matrix;
}

// Second derivatives at the knots of the not-a-knot spline, as an operator on the knot values.
Eigen::MatrixXd splineCurvature(const WavelengthGrid& knots)
{
  const Eigen::Index n = knots.size();
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, n);
  const auto step = [&knots](Eigen::Index i) { return knots[i + 1] - knots[i]; };
  for (Eigen::Index i = 1; i + 1 < n; ++i)
  {
    left(i, i - 1) = step(i - 1);
    left(i, i) = 2.0 * (step(i - 1) + step(i));
    left(i, i + 1) = step(i);
    right(i, i - 1) = 6.0 / step(i - 1);
    right(i, i) = -6.0 / step(i - 1) - 6.0 / step(i);
    right(i, i + 1) = 6.0 / step(i);
  }
  // The third derivative goes through the second and the last but one knot unchanged.
  left.row(0).head(3) << step(1), -step(0) - step(1), step(0);
  left.row(n - 1).tail(3) << step(n - 2), -step(n - 3) - step(n - 2), step(n - 3);
  return left.partialPivLu().solve(right);
}

Eigen::MatrixXd splineMatrix(const WavelengthGrid& from, const WavelengthGrid& to)
{
  const Eigen::MatrixXd curvature = splineCurvature(from);
  Eigen::MatrixXd matrix = linearMatrix(from, to);
  for (Eigen::Index i = 0; i < to.size(); ++i)
  {
    const Position at = locate(from, to[i]);
    const double step = from[at.index + 1] - from[at.index];
    const double b = at.fraction;
    const double a = 1.0 - b;
    const double scale = step * step / 6.0;
    matrix.row(i) += scale * (a * a * a - a) * curvature.row(at.index) +
      scale * (b * b * b - b) * curvature.row(at.index + 1);
  }
  return matrix;
}

void requireSize(const WavelengthGrid& grid, Eigen::Index least, const char* method)
{
  if (grid.size() < least)
  {
    reject(
      method, " interpolation needs at least ", least, " wavelengths; the grid has ", grid.size());
  }
}
}

InterpolationMethod recommendedInterpolation(const WavelengthGrid& from) noexcept
{
  if (from.size() >= SpragueLeast && from.step())
  {
    return InterpolationMethod::Sprague;
  }
  return from.size() >= SplineLeast ? InterpolationMethod::CubicSpline
                                    : InterpolationMethod::Linear;
}

bool needsExtrapolation(const WavelengthGrid& from, const WavelengthGrid& to) noexcept
{
  return to.front() < from.front() - SameWavelength || to.back() > from.back() + SameWavelength;
}

Eigen::MatrixXd resamplingMatrix(
  const WavelengthGrid& from, const WavelengthGrid& to, InterpolationMethod method)
{
  if (method == InterpolationMethod::Recommended)
  {
    method = recommendedInterpolation(from);
  }
  switch (method)
  {
    case InterpolationMethod::Sprague:
      requireSize(from, SpragueLeast, "Sprague");
      if (!from.step())
      {
        throw std::invalid_argument("Sprague interpolation needs a uniform wavelength grid; the "
                                    "spacing of this one varies. Take the cubic spline");
      }
      return spragueMatrix(from, to);
    case InterpolationMethod::CubicSpline:
      requireSize(from, SplineLeast, "cubic spline");
      return splineMatrix(from, to);
    case InterpolationMethod::CubicLagrange:
      return lagrangeMatrix(from, to);
    default:
      return linearMatrix(from, to);
  }
}

} // namespace msi

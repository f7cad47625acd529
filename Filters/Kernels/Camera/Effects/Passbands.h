// What effects of lamp and filters share: places on the grid, and passbands between those of their neighbours.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

#include <Eigen/Core>

#include <memory>

namespace msi
{

constexpr double MiddleWavelength = 550.0;

// Wavelengths mapped so that the grid is [-1, 1].
Eigen::ArrayXd gridPosition(const WavelengthGrid& grid);

// Sum of the Legendre polynomials P1 to P3.
Eigen::ArrayXd legendre(const Eigen::ArrayXd& x, double first, double second, double third);

// Channel centroids; the middle of the grid where a row has no weight.
Eigen::ArrayXd passbandCentroids(const CameraModel& camera);

// The operator of the form of_neighbours: each passband, with its own response to white, becomes what the parabola through it and
// its neighbours gives at `shift` nm from its centroid, then spreads over its neighbours until it has `variance` (nm^2) more: the
// exponential of variance / 2 times the parabolas' second derivatives. For cameras whose passbands are known by what they did to
// samples, not by their shape: a responsivity that was fitted to samples need not do to other spectra, like derivatives of these,
// what the real one does, but its neighbours' responses are real ones. Passbands should be alike and overlap. At an end of the grid
// that has no room for a further passband, what would spread beyond stays. Unchanged where three channels of different centroids
// are missing.
std::unique_ptr<ResponsivityOperator> makePassbandsOfNeighbours(
  const BoundEffect& effect, double shift, double variance);
bool goesByNeighbours(const BoundEffect& effect);

} // namespace msi

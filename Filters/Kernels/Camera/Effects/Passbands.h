// What effects of lamp and filters share: places on the grid, and passbands that move or widen under a light that stays.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/MovedSpectrum.h"

#include <Eigen/Core>

#include <memory>

namespace msi
{

constexpr double MiddleWavelength = 550.0;

// Wavelengths mapped so that the grid is [-1, 1].
Eigen::ArrayXd gridPosition(const WavelengthGrid& grid, const Eigen::ArrayXd& wavelength);
Eigen::ArrayXd gridPosition(const WavelengthGrid& grid);

// Sum of the Legendre polynomials P1 to P3.
Eigen::ArrayXd legendre(const Eigen::ArrayXd& x, double first, double second, double third);

// Channel centroids; the middle of the grid where a row has no weight.
Eigen::ArrayXd passbandCentroids(const CameraModel& camera);

// Of Gaussians, by their squares, so that little far from the passband counts for nothing; nm^2. middles: K, nm. No less than that of
// a passband of one step.
Eigen::ArrayXd passbandVariances(const CameraModel& camera, const Eigen::ArrayXd& middles);

// The operator of the form in_light, of filter_shift and filter_bandwidth: shift (nm) and factor of each channel.
std::unique_ptr<ResponsivityOperator> makePassbandsInLight(
  const BoundEffect& effect, const Eigen::ArrayXd& shift, const Eigen::ArrayXd& factor);
bool movesInLight(const BoundEffect& effect);
// 1 at 550 nm, more or less beyond: how the change grows over the channels. Of the effect's secondary parameter `growth`.
EffectParameter growthParameter();
Eigen::ArrayXd growthOf(const BoundEffect& effect);

// The form in_light; `primary` is what moves or widens, `size` where a fit starts.
EffectForm inLightForm(const char* meaning, const EffectParameter& primary, double size,
  unsigned traits = FormTrait::None);

// The operator of the form of_neighbours: each passband, with its own response to white, becomes what the parabola through it and
// its neighbours gives at `shift` nm from its centroid, and half of `variance` (nm^2) times the parabola's second derivative
// is added. For cameras whose passbands are known by what they did to samples, not by their shape: a responsivity that was fitted to
// samples need not do to other spectra, like derivatives of these, what the real one does, but its neighbours' responses are
// real ones. Passbands should be alike and overlap. At an end of the grid that has no room for a further passband, what
// the added variance would take beyond stays. Unchanged where three channels of different centroids are missing.
std::unique_ptr<ResponsivityOperator> makePassbandsOfNeighbours(
  const BoundEffect& effect, double shift, double variance);
bool goesByNeighbours(const BoundEffect& effect);

} // namespace msi

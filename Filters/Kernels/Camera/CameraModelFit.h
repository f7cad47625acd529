// The camera's responsivity and dark response from one measured chart.
#pragma once

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Numerics/FitSummary.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace msi
{

struct CameraModelFitOptions
{
  std::vector<std::string> channels = {}; // empty: C1, C2, ...
  // Where known: the filters as designed. The fit then departs from them as little as the chart asks for.
  std::optional<CameraModel> nominal = std::nullopt;
  // Where known, from a lens cap: not fitted.
  std::optional<Eigen::VectorXd> dark = std::nullopt;
  double passbandWidth =
    15.0;          // nm from a channel's center at which the penalty on far light sets in
  int folds = 5;   // of the cross-validation that chooses the weights of the penalties
  int draws = 100; // of the bootstrap that gives the uncertainty; 0: none
  // The responses are straightened by the curve that is found, where one is.
  bool detectorCurve = false;
  std::uint64_t seed = 1;
};

// One pair of penalty weights that was tried.
struct CameraModelFitTrial
{
  double locality = 0.0;
  double smoothness = 0.0;
  double heldOutRms = 0.0;
  double freedom = 0.0; // effective number of coefficients a channel
};

// A curve of the detector, y = (1 - square) u + square u^2 with u = M r + b: white keeps its response.
struct DetectorCurve
{
  double square = 0.0;     // the one whose camera predicts samples left out best, from -0.4 to 0.4
  double heldOutRms = 0.0; // of that camera
  double deviations =
    0.0; // of the gain in squared error, sample by sample, over its standard error
  bool found() const noexcept { return deviations > 3.0; }
};

struct CameraModelFit
{
  CameraModel camera;

  // Empty where responses are not relative to white (above 2). `camera` is linear all the same: with
  // CameraModelFitOptions::detectorCurve and a curve found it is the camera before that curve.
  std::optional<DetectorCurve> curve = std::nullopt;

  // Standard errors from the bootstrap over samples; empty without draws.
  Eigen::MatrixXd responsivityError = {}; // K x N
  Eigen::VectorXd darkError = {};         // K
  // Covariance of (a channel's row of M, its dark response), N + 1 square, one a channel.
  std::vector<Eigen::MatrixXd> covariance = {};

  Eigen::VectorXd channelRms = {}; // K, of the residuals on the chart
  double heldOutRms = 0.0;         // cross-validated, all channels together
  std::vector<CameraModelFitTrial> trials = {};
  CameraModelFitTrial chosen = {};

  // What the chart says without the penalties. Of the principal directions of the centered reflectances,
  // `determined` are those along which the standard error of a row of M is below half of a typical row's
  // norm. Along the others, the columns of `undetermined` (N x (N - determined), orthonormal), M
  // comes from the assumptions: not negative, local, smooth, near the nominal camera.
  Eigen::Index determined = 0;
  Eigen::MatrixXd undetermined = {};
  // N, nm: width over which the chart alone smears M at each wavelength, step / (share of that wavelength
  // in the determined directions).
  Eigen::VectorXd resolution = {};

  FitSummary summary = {}; // status: what the chart cannot determine, in a sentence

  // Standard error of the predicted response of a channel to a reflectance (N). NaN without draws.
  double predictionError(Eigen::Index channel, const Eigen::VectorXd& reflectance) const;
};

// Fits u = M r + b, every channel by itself:
//
//   min  mean (u - m r - b)^2 + V [ locality sum_j d_j (m_j - p_j)^2 + smoothness sum_j (D2 (m - p))_j^2 ],  m >= 0
//
// d_j = ((wavelength_j - center) / passbandWidth)^4, V the mean variance of the reflectances, D2 second
// differences; both sums are scaled so that their weights mean the same on every grid. center is where a first,
// smooth fit has its passband. Without a nominal camera p = 0. With one, p is its row, scaled to the chart, center its
// centroid, and d_j is larger by 1.
// The weights are common to all channels: of those tried, the ones with the fewest effective coefficients
// whose mean squared held-out error lies within one standard error of the smallest (Breiman's rule).
// A sample with a value that is not finite takes no part.
// Whether the detector is curved: with the weights chosen, the curve whose straightened responses are predicted best on
// samples left out, errors taken back to the responses' own scale.
//
// Shapes: reflectance N x S, response K x S.
// Errors: std::invalid_argument for shapes that disagree, a grid that is not uniform, fewer than 10 samples, folds
//         below 2 or above the number of samples, draws below 0.
// Cost:   about trials x folds x K small non-negative least squares, and draws x K more.
CameraModelFit fitCameraModel(const WavelengthGrid& wavelengths, const Eigen::MatrixXd& reflectance,
  const Eigen::MatrixXd& response, const CameraModelFitOptions& options = {});

} // namespace msi

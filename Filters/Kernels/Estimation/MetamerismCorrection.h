// Cross-media metamerism correction: the method "banded".
#pragma once

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/AffineTransform.h"
#include "Kernels/Numerics/FitSummary.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace msi
{

// Which elements of D_s are free, beside the constant: the channel itself, or also its neighbours.
enum class BandStructure
{
  Automatic,
  Diagonal,
  Tridiagonal
};

// Automatic: diagonal where the channels stand 30 nm apart or more on average, so that they hardly
// overlap (9 channels 400, 440, .., 680, 700), else tridiagonal (16 channels 400, 420, .., 700).
// Without wavelengths the channels are taken to span 300 nm, so up to 11 are diagonal.
BandStructure bandStructureFor(
  Eigen::Index channels, const std::optional<WavelengthGrid>& channelWavelengths = std::nullopt);

// How color is computed for the second stop rule: tristimulus values are weights * reflectance, and
// CIEDE2000 is taken in the CIELAB space of the white.
struct ColorStopRule
{
  Eigen::MatrixXd tristimulusWeights; // 3 x N
  Eigen::Vector3d white = Eigen::Vector3d::Constant(100.0);
  double threshold = 0.01; // stop when the mean CIEDE2000 of the tuning samples changes by less
};

struct MetamerismOptions
{
  BandStructure structure = BandStructure::Automatic;
  std::optional<WavelengthGrid> channelWavelengths; // K values; only for the automatic choice
  int maximumRounds = 2;
  std::optional<ColorStopRule> colorStop; // may stop before maximumRounds, from the second round on
  double tuningWeight = 0.0;              // eta; 0 means sqrt(L_A / L_T), Eq. 19
  double rankTolerance = -1.0;            // as in CalibrationOptions; negative: 1e-10 for W_s+
};

struct MetamerismRound
{
  double responseResidualRms = 0.0;    // of Eq. 16, in response units
  double reflectanceResidualRms = 0.0; // of W D V~ against S after this round's W
  std::optional<double>
    meanColorDifference; // CIEDE2000 of the tuning samples; with a ColorStopRule
};

struct MetamerismFit
{
  AffineTransform reflectance; // W, N x (K+1)
  AffineTransform metamerism;  // D without its last row (0, 1), K x (K+1)
  AffineTransform composite;   // W D, N x (K+1): response of the target medium -> reflectance
  BandStructure structure;     // Diagonal or Tridiagonal
  double tuningWeight;         // eta that was used
  std::vector<MetamerismRound> history; // one entry a round
  FitSummary summary;
};

// 1. W = R U~+.  2. rows of (D_s, d) by least squares over their free elements, from
// (D_s, d) V~ = W_s+ (S - w 1').  3. W = (R, eta S)(U~, eta D V~)+.  4. again 2 and 3.
//
// Source:  "Correcting cross-media instrument metamerism for reflectance estimation in multispectral
//          imaging", 2011, doi 10.1364/JOSAA.28.000511, Eqs. 9, 14-20.
// Shapes:  calibration N x L_A and K x L_A, tuning N x L_T and K x L_T.
// Errors:  std::invalid_argument where a set is empty or not finite, where bands or channels of the
//          sets differ, where K > N (W_s+ is then no left inverse), where maximumRounds < 1, where the options' shapes disagree,
//          and where L_T is less than a row's unknowns (4, or 2 for a diagonal structure). With the
//          automatic structure 2 or 3 tuning samples are enough: it takes the diagonal one and says so.
//          A row whose system is singular takes, among its least-squares solutions, the one nearest to
//          "leave the channel as it is"; the summary is then not complete and names the channels.
// Summary: residualRms of the tuning reflectances; rank and condition of the last W system;
//          unknowns of W and D together; iterations = rounds.
// Cost:    O(rounds (L K^2 + N L K + N K^2)).
MetamerismFit fitMetamerismCorrection(
  const SampleSet& calibration, const SampleSet& tuning, const MetamerismOptions& options = {});

} // namespace msi

// What the two Wiener estimators share.
#pragma once

#include "Kernels/Estimation/Methods/Methods.h"
#include "Kernels/Estimation/Responsivity.h"

namespace msi
{

struct WienerFit
{
  AffineTransform transform;
  double ridge;        // of the responsivities
  double tuningWeight; // of a tuning sample beside a chart sample
  FitSummary summary;
};

// The method wiener.
WienerFit fitWiener(const SampleSet& calibration, const SampleSet& tuning);

// variance correlation^|i - j|.
Eigen::MatrixXd markovCovariance(Eigen::Index bands, double variance, double correlation);

// m + C M' (M C M' + noise)^-1 (u - M m - b) for spectra of mean m and covariance C.
AffineTransform wienerTransform(
  const ResponsivityFit& fit, const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance);

} // namespace msi

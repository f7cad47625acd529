// Differences between spectra, without regard to color.
#pragma once

#include <Eigen/Core>

namespace msi
{

// Per sample, over the N bands of one column. Measured and estimated are N x samples and are
// reflectance factors; difference has one value a sample. For shapes already checked. A sample with
// a NaN gives NaN for itself and for no other; a value does not depend on the rest of the block.

// sqrt(mean((s - s^)^2)): Eq. 21 of "Correcting cross-media instrument metamerism for reflectance
// estimation in multispectral imaging", 2011, doi 10.1364/JOSAA.28.000511.
void spectralRms(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated,
  Eigen::Ref<Eigen::VectorXd> difference) noexcept;
void spectralRms(const Eigen::Ref<const Eigen::MatrixXf>& measured,
  const Eigen::Ref<const Eigen::MatrixXf>& estimated,
  Eigen::Ref<Eigen::VectorXf> difference) noexcept;

// mean(|s - s^|).
void spectralMeanAbsoluteError(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated,
  Eigen::Ref<Eigen::VectorXd> difference) noexcept;

// The goodness-of-fit coefficient |s . s^| / (|s| |s^|), 1 for spectra that differ by a factor only.
// Source: Romero, Garcia-Beltran and Hernandez-Andres, 1997, doi 10.1364/JOSAA.14.001007.
// NaN where one of the spectra is zero everywhere.
void goodnessOfFit(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated,
  Eigen::Ref<Eigen::VectorXd> coefficient) noexcept;

// The spectral angle between both, in radians: 0 for spectra that differ by a positive factor only.
// Source: Kruse and others, 1993, doi 10.1016/0034-4257(93)90013-N. Computed from the distance of the
// unit vectors, which keeps small angles exact. NaN where one of the spectra is zero everywhere.
void spectralAngle(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated, Eigen::Ref<Eigen::VectorXd> angle) noexcept;

} // namespace msi

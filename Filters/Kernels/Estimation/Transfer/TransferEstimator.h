// What the method "transfer" has learned, run on blocks of pixels.
#pragma once

#include "Kernels/Estimation/ReflectanceEstimator.h"
#include "Kernels/Estimation/Transfer/TransferExpert.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace msi
{

// Rms difference of the mean of float blocks from that of double blocks, reflectance factor: a tenth of
// what a spectrophotometer repeats.
constexpr double TransferFloatTolerance = 1e-4;

// An immutable estimator of target reflectance with its uncertainty; copies share the parameters.
//
// Names:  bandVariance (N x 1); affine.coefficients (N x (K+1)), affine.share (1 x 1); and for each of
//         the Gaussian processes E, linear and squareRoot: E.scalars (7 x 1: share of the mean, share
//         of the variance, response scale, feature scale, length, constant and linear part of the
//         prior variance), E.channels (K x 3: log gain, offset, feature center), E.points (K x m),
//         E.weights (3 x m), E.coefficients (m x N), E.center (N x 1), E.reduction (m x m).
// Shapes: a block of responses is channels() x pixels, mean and standard deviation are
//         bands() x pixels, all column-major and contiguous.
// Errors: the constructor throws std::invalid_argument naming a matrix that is missing, has the wrong
//         shape (both shapes are named), or holds a value that is not finite.
// Bytes:  a pixel's result depends on the pixel alone: not on the block it is in, the thread or the
//         instruction set. A NaN or infinite response gives NaN in every band of that pixel.
// Float:  the mean of float blocks is computed in float from fewer points (ReducedTransfer.h). For
//         responses like those of the samples its rms difference from the mean in double is one to
//         three times TransferFloatTolerance. The standard deviation is computed in double.
// Cost:   per pixel and expert about m (2 K + 2 N + 40) flop for the mean and 2 m^2 more for the
//         standard deviation; a fifth to a tenth of the former for float blocks, after up to half a
//         second of preparation with the first one. Scratch memory is allocated once a call.
class TransferEstimator final : public ReflectanceEstimator
{
public:
  explicit TransferEstimator(const NamedMatrices& parameters);
  NamedMatrices parameters() const override;

  Eigen::Index bands() const noexcept override;
  Eigen::Index channels() const noexcept override;
  bool knowsUncertainty() const noexcept override { return true; }

  // standardDeviation may be null. It is of the error to expect against a measurement, scaled so that
  // mean +- 1.645 standard deviations holds about 90 % of the measured values.
  void apply(const double* response, double* mean, double* standardDeviation,
    Eigen::Index pixels) const noexcept override;
  void apply(const float* response, float* mean, float* standardDeviation,
    Eigen::Index pixels) const noexcept override;

private:
  struct Implementation;
  std::shared_ptr<const Implementation> Impl;
};

// What an estimator is made of.
struct TransferMixture
{
  std::vector<TransferExpert> experts; // linear, square root
  std::vector<double> meanShares;
  std::vector<double> varianceShares;
  Eigen::MatrixXd affine; // N x (K+1)
  double affineShare;
  Eigen::VectorXd bandVariance; // N
};

// The names above.
NamedMatrices transferParameters(const TransferMixture& mixture);

} // namespace msi

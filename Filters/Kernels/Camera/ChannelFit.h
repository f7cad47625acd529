// The penalised non-negative fit of every channel that CameraModelFit repeats over folds and draws.
#pragma once

#include "Kernels/Camera/CameraModelFit.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

struct PenaltyWeights
{
  double locality;
  double smoothness;
};

// Means, covariance and cross-covariance of a choice of samples; uncentered where the dark response is known.
struct ChannelMoments
{
  Eigen::VectorXd meanReflectance; // N
  Eigen::VectorXd meanResponse;    // K
  Eigen::MatrixXd covariance;      // N x N
  Eigen::MatrixXd cross;           // N x K
};

struct FittedRows
{
  Eigen::MatrixXd responsivity; // K x N
  Eigen::VectorXd dark;         // K
  double freedom = 0.0;         // effective coefficients, mean over the channels
  int steps = 0;
  bool converged = true;
};

class ChannelFitProblem
{
public:
  ChannelFitProblem(const WavelengthGrid& wavelengths, const Eigen::MatrixXd& reflectance,
    const Eigen::MatrixXd& response, const CameraModelFitOptions& options);

  Eigen::Index samples() const noexcept { return Reflectance.cols(); }

  // A sample may stand in the list more than once.
  ChannelMoments moments(const std::vector<Eigen::Index>& samples) const;
  // Where each channel has its passband, nm: of the nominal camera or of a first smooth fit.
  Eigen::VectorXd centers(const ChannelMoments& moments) const;
  FittedRows solve(const ChannelMoments& moments, const Eigen::VectorXd& centers,
    const PenaltyWeights& weights) const;
  Eigen::VectorXd residual(const FittedRows& rows, Eigen::Index sample) const;
  std::vector<PenaltyWeights> candidates() const;

private:
  Eigen::MatrixXd penalty(double center, const PenaltyWeights& weights) const;
  Eigen::RowVectorXd prior(const ChannelMoments& moments, Eigen::Index channel) const;

  WavelengthGrid Grid;
  const Eigen::MatrixXd& Reflectance;
  const Eigen::MatrixXd& Response;
  const CameraModelFitOptions& Options;
  double MeanVariance;
  Eigen::MatrixXd Roughness; // D2' D2, scaled
};

} // namespace msi

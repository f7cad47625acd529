#include "Kernels/Estimation/RidgeCalibration.h"

#include "Kernels/Numerics/ThinSvd.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr double FirstExponent = -8.0;
constexpr double LastExponent = 2.0;
constexpr double ExponentStep = 0.25;

// Responses centered and scaled, reflectances centered, samples by rows.
struct CenteredSystem
{
  Eigen::VectorXd responseMean;
  Eigen::VectorXd responseScale; // 1 for a channel that never varies
  Eigen::VectorXd reflectanceMean;
  Eigen::MatrixXd left;     // L x r
  Eigen::VectorXd singular; // r
  Eigen::MatrixXd right;    // K x r
  Eigen::MatrixXd outputs;  // L x N
  Eigen::MatrixXd along;    // r x N, outputs along the singular directions
  double singularLargest;
};

CenteredSystem centeredSystem(const SampleSet& samples)
{
  CenteredSystem system;
  const auto count = static_cast<double>(samples.size());
  system.responseMean = samples.response.rowwise().mean();
  system.reflectanceMean = samples.reflectance.rowwise().mean();
  Eigen::MatrixXd inputs = (samples.response.colwise() - system.responseMean).transpose();
  system.outputs = (samples.reflectance.colwise() - system.reflectanceMean).transpose();
  system.responseScale = (inputs.colwise().squaredNorm() / count).cwiseSqrt().transpose();
  for (Eigen::Index k = 0; k < inputs.cols(); ++k)
  {
    if (!(system.responseScale[k] > 1e-12 * std::abs(system.responseMean[k])))
    {
      system.responseScale[k] = 1.0;
      inputs.col(k).setZero();
    }
  }
  inputs *= system.responseScale.cwiseInverse().asDiagonal();
  const ThinSvd svd = thinSvd(inputs);
  const double tolerance = std::numeric_limits<double>::epsilon() *
    static_cast<double>(std::max(inputs.rows(), inputs.cols()));
  system.singularLargest = svd.singular.size() > 0 ? svd.singular[0] : 0.0;
  const Eigen::Index rank = (svd.singular.array() > tolerance * system.singularLargest).count();
  system.left = svd.left.leftCols(rank);
  system.singular = svd.singular.head(rank);
  system.right = svd.right.leftCols(rank);
  for (Eigen::Index k = 0; k < inputs.cols(); ++k)
  {
    if (inputs.col(k).isZero(0.0))
    {
      system.right.row(k).setZero(); // free of the rounding of the decomposition
    }
  }
  system.along = system.left.transpose() * system.outputs;
  return system;
}

// Shrinkage s^2 / (s^2 + lambda L) of each singular direction.
Eigen::VectorXd shrinkage(const CenteredSystem& system, double penalty)
{
  const double added = penalty * static_cast<double>(system.outputs.rows());
  const Eigen::ArrayXd squared = system.singular.array().square();
  return squared / (squared + added);
}

Eigen::VectorXd leverageAt(const CenteredSystem& system, double penalty)
{
  return (system.left.cwiseAbs2() * shrinkage(system, penalty)).array() +
    1.0 / static_cast<double>(system.outputs.rows());
}

// What the fit to all others leaves of each sample; L x N.
Eigen::MatrixXd leftOutAt(const CenteredSystem& system, double penalty)
{
  const Eigen::MatrixXd residual =
    system.outputs - system.left * (shrinkage(system, penalty).asDiagonal() * system.along);
  return (1.0 - leverageAt(system, penalty).array()).inverse().matrix().asDiagonal() * residual;
}

double leaveOneOutRms(const CenteredSystem& system, double penalty)
{
  // A leverage of one says nothing about its sample: the system has no freedom left.
  constexpr double LargestLeverage = 1.0 - 1e-10;
  return leverageAt(system, penalty).maxCoeff() > LargestLeverage
    ? std::numeric_limits<double>::infinity()
    : std::sqrt(leftOutAt(system, penalty).cwiseAbs2().mean());
}

AffineTransform transformAt(const CenteredSystem& system, double penalty)
{
  const Eigen::VectorXd weight = shrinkage(system, penalty).cwiseQuotient(system.singular);
  const Eigen::MatrixXd scaled = (system.right * (weight.asDiagonal() * system.along)).transpose();
  Eigen::MatrixXd coefficients(scaled.rows(), scaled.cols() + 1);
  coefficients.leftCols(scaled.cols()) = scaled * system.responseScale.cwiseInverse().asDiagonal();
  coefficients.rightCols(1) =
    system.reflectanceMean - coefficients.leftCols(scaled.cols()) * system.responseMean;
  return AffineTransform(std::move(coefficients));
}
}

RidgeFit fitRidge(const SampleSet& samples)
{
  requireValid(samples, "calibration");
  constexpr Eigen::Index FewestSamples = 3;
  if (samples.size() < FewestSamples)
  {
    throw std::invalid_argument("there are " + std::to_string(samples.size()) +
      " calibration samples; choosing the penalty by leaving one out needs at least 3");
  }
  const CenteredSystem system = centeredSystem(samples);
  double best = 0.0;
  double bestRms = leaveOneOutRms(system, 0.0);
  const int steps = static_cast<int>((LastExponent - FirstExponent) / ExponentStep);
  for (int step = 0; step <= steps; ++step)
  {
    const double penalty = std::pow(10.0, FirstExponent + ExponentStep * step);
    const double rms = leaveOneOutRms(system, penalty);
    if (rms < bestRms)
    {
      best = penalty;
      bestRms = rms;
    }
  }
  CalibrationFit fit{ transformAt(system, best), {} };
  fit.summary.residualRms =
    std::sqrt((fit.transform(samples.response) - samples.reflectance).cwiseAbs2().mean());
  fit.summary.rank = system.singular.size() + 1;
  fit.summary.condition =
    system.singular.size() > 0 ? system.singularLargest / system.singular.tail(1)[0] : 1.0;
  fit.summary.unknowns = samples.bands() * (samples.channels() + 1);
  fit.summary.samples = samples.size();
  fit.summary.iterations = 1;
  std::ostringstream status;
  status.precision(2);
  status << "penalty " << best << ", leave-one-out rms " << bestRms;
  fit.summary.status = status.str();
  return { std::move(fit), best, bestRms, leftOutAt(system, best).transpose(),
    leverageAt(system, best) };
}

} // namespace msi

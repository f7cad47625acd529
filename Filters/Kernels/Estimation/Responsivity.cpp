#include "Kernels/Estimation/Responsivity.h"

#include <Eigen/Cholesky>

namespace msi
{

Eigen::VectorXd weightedMean(const Eigen::MatrixXd& values, const Eigen::VectorXd& weights)
{
  return values * weights / weights.sum();
}

ResponsivityFit fitResponsivity(
  const SampleSet& samples, const Eigen::VectorXd& weights, double ridge)
{
  const Eigen::VectorXd meanReflectance = weightedMean(samples.reflectance, weights);
  const Eigen::VectorXd meanResponse = weightedMean(samples.response, weights);
  const Eigen::MatrixXd r = samples.reflectance.colwise() - meanReflectance;
  const Eigen::MatrixXd u = samples.response.colwise() - meanResponse;
  const double total = weights.sum();
  const Eigen::MatrixXd weighted = r * weights.asDiagonal();
  Eigen::MatrixXd covariance = weighted * r.transpose() / total;
  constexpr double LeastVariance = 1e-30;
  covariance.diagonal().array() +=
    ridge * covariance.trace() / static_cast<double>(r.rows()) + LeastVariance;
  const Eigen::MatrixXd cross = weighted * u.transpose() / total;
  Eigen::MatrixXd coefficients(u.rows(), r.rows() + 1);
  coefficients.leftCols(r.rows()) = covariance.ldlt().solve(cross).transpose();
  coefficients.rightCols(1) = meanResponse - coefficients.leftCols(r.rows()) * meanReflectance;
  const Eigen::MatrixXd residual = u - coefficients.leftCols(r.rows()) * r;
  constexpr double LeastNoise = 1e-12;
  const double least = LeastNoise * samples.response.cwiseAbs2().mean();
  Eigen::VectorXd noise = (residual.cwiseAbs2() * weights / total).cwiseMax(least);
  return { AffineTransform(std::move(coefficients)), std::move(noise) };
}

} // namespace msi

#include "Kernels/Estimation/Transfer/TransferFeatures.h"

#include <cmath>

namespace msi
{

namespace
{
// Of features whose root mean square is about 1: less is rounding, every sample has the same response.
constexpr double LeastDeviation = 1e-9;
}

Eigen::MatrixXd TransferFeatures::ofChart(const Eigen::MatrixXd& responses) const
{
  Eigen::MatrixXd x =
    (responses / responseScale).unaryExpr([this](double z) { return toSpace(space, z); });
  return (x.colwise() - center) / scale;
}

Eigen::MatrixXd TransferFeatures::ofTarget(const Eigen::MatrixXd& responses) const
{
  const Eigen::MatrixXd corrected =
    (logGain.array().exp().matrix().asDiagonal() * responses).colwise() + responseScale * offset;
  return ofChart(corrected);
}

TransferFeatures featuresOf(TransferSpace space, const Eigen::MatrixXd& chartResponses)
{
  const Eigen::Index channels = chartResponses.rows();
  TransferFeatures features;
  features.space = space;
  const double rms =
    std::sqrt(chartResponses.squaredNorm() / static_cast<double>(chartResponses.size()));
  features.responseScale = rms > 0.0 ? rms : 1.0;
  features.center = Eigen::VectorXd::Zero(channels);
  features.logGain = Eigen::VectorXd::Zero(channels);
  features.offset = Eigen::VectorXd::Zero(channels);
  const Eigen::MatrixXd raw = features.ofChart(chartResponses);
  const double mean = raw.mean();
  const double deviation = std::sqrt((raw.array() - mean).square().mean());
  features.center = raw.rowwise().mean();
  features.scale = deviation > LeastDeviation ? deviation : 1.0;
  return features;
}

} // namespace msi

#include "Kernels/Gap/Samples/GapEvidence.h"

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace msi
{

namespace
{
constexpr Eigen::Index FewSamples = 3;

// Energy explained over energy left where the gap shrinks by Decision::SmallPart.
double leastOverLeft()
{
  return std::pow(1.0 - Decision::SmallPart, -2) - 1.0;
}
}

Eigen::MatrixXd measuredOnly(const GapData& data, const Eigen::MatrixXd& values)
{
  return data.measured().select(values, 0.0);
}

double limitIntegration(GapData& data, const Eigen::MatrixXd& integration, double unpredicted)
{
  const double allowed = measuredOnly(data, integration).sum();
  const double other = measuredOnly(data, data.variance).sum() - allowed;
  double kept = 1.0;
  if (allowed > 0.0)
  {
    kept = std::fmin(std::fmax((unpredicted - other) / allowed, 0.0), 1.0);
    data.variance -= (1.0 - kept) * integration;
  }
  return (1.0 - kept) * allowed / static_cast<double>(data.elements);
}

GroupEnergies energiesOf(const GapData& data, const SampleList& samples,
  const Eigen::MatrixXd& before, const Eigen::MatrixXd& after)
{
  GroupEnergies energies(data.samples(), 3);
  energies << before.colwise().squaredNorm().transpose(), after.colwise().squaredNorm().transpose(),
    measuredOnly(data, data.variance).colwise().sum().transpose();
  return energies(samples, Eigen::all);
}

bool predictable(const GapData& data, const Eigen::MatrixXd& gap, const AxisShares& shares)
{
  const Eigen::ArrayXd gain =
    gap.colwise().squaredNorm() - shares.heldOutResidual.colwise().squaredNorm();
  const double sum = gain.sum();
  const double square = gain.square().sum();
  const auto samples = static_cast<double>(data.usable.size());
  const double error = std::sqrt(std::fmax(square - sum * sum / samples, 0.0));
  const double noise = measuredOnly(data, data.variance).sum();
  return sum > Decision::SureDeviations * error && sum > Decision::SmallPart * noise;
}

double negligibleEnergy(
  const GapData& data, const Eigen::MatrixXd& after, const Eigen::MatrixXd& integration)
{
  return std::fmax(Decision::EstimateFactor * measuredOnly(data, integration).sum(),
    leastOverLeft() * after.squaredNorm());
}

double noticed(const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
  const Eigen::MatrixXd& integration)
{
  const Eigen::ArrayXd taken = before.colwise().squaredNorm() - after.colwise().squaredNorm();
  const Eigen::ArrayXd allowed =
    Decision::EstimateFactor * measuredOnly(data, integration).colwise().sum();
  const double explained = taken.sum();
  if (!(explained > 0.0))
  {
    return 0.0;
  }
  const double beyond = (taken - allowed).max(0.0).sum();
  return std::fmin(explained / (leastOverLeft() * after.squaredNorm()),
    std::fmax(explained / allowed.sum(), 2.0 * beyond / explained));
}

IndexList oddElements(
  const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after)
{
  // Causes that odd samples have led astray leave more of the others.
  const Eigen::MatrixXd least = before.cwiseAbs2().cwiseMin(after.cwiseAbs2());
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXi channel = Eigen::VectorXi::LinSpaced(
    static_cast<int>(data.channels()), 0, static_cast<int>(data.channels()) - 1);
  return oddElements(data.measured().select(data.weight.cwiseProduct(least), none),
    channel.replicate(1, data.samples()), data.leftOut.size());
}

bool inFewSamples(const GapData& data, const Eigen::MatrixXd& change)
{
  Eigen::VectorXd energy = measuredOnly(data, change).colwise().squaredNorm();
  std::sort(energy.begin(), energy.end(), std::greater<>());
  return energy.head(std::min(energy.size(), FewSamples)).sum() >
    (1.0 - Decision::SmallPart) * energy.sum();
}

} // namespace msi

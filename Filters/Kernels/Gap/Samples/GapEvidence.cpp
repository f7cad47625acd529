#include "Kernels/Gap/Samples/GapEvidence.h"

#include "Kernels/Gap/Samples/TableDecisions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace msi
{

Eigen::MatrixXd measuredOnly(const GapData& data, const Eigen::MatrixXd& values)
{
  return (data.count.array() > 0.0).select(values, 0.0);
}

namespace
{
// Of normal values of mean 0, by the median of their sizes.
double middleVariance(std::vector<double>& values)
{
  std::transform(
    values.begin(), values.end(), values.begin(), [](double v) { return std::fabs(v); });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::pow(1.4826 * *middle, 2);
}
}

void setUnknownNoise(GapData& data)
{
  data.variance = Eigen::MatrixXd::Zero(data.channels(), data.samples());
  const Eigen::MatrixXd residual =
    shareOverAxes(data, measuredOnly(data, data.observed - data.simulated), false).heldOutResidual;
  for (Eigen::Index k = 0; k < data.channels(); ++k)
  {
    std::vector<double> values;
    std::vector<double>
      differences; // second, between neighbouring channels: of noise, six times its variance
    const Eigen::Index first =
      std::clamp<Eigen::Index>(k - 1, 0, std::max<Eigen::Index>(data.channels() - 3, 0));
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      if (data.count(k, i) > 0.0)
      {
        values.push_back(residual(k, i));
      }
      if (data.channels() > 2 && data.count.col(i).segment(first, 3).minCoeff() > 0.0)
      {
        const auto three = residual.col(i).segment(first, 3);
        differences.push_back(three[0] - 2.0 * three[1] + three[2]);
      }
    }
    if (!values.empty())
    {
      double variance = middleVariance(values);
      if (!differences.empty())
      {
        variance = std::fmin(
          variance, middleVariance(differences) / 6.0 + std::pow(TableDecision::SampleScatter, 2));
      }
      data.variance.row(k).setConstant(variance + 1e-12);
    }
  }
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

GroupEnergies energiesOf(
  const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after)
{
  GroupEnergies energies;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    if (data.usable[static_cast<std::size_t>(i)] != 0)
    {
      energies.before.push_back(before.col(i).squaredNorm());
      energies.after.push_back(after.col(i).squaredNorm());
      energies.noise.push_back(
        (data.count.col(i).array() > 0.0).select(data.variance.col(i), 0.0).sum());
    }
  }
  return energies;
}

bool predictable(const GapData& data, const Eigen::MatrixXd& gap, const AxisShares& shares)
{
  double sum = 0.0;
  double square = 0.0;
  double samples = 0.0;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    if (data.usable[static_cast<std::size_t>(i)] != 0)
    {
      const double gain = gap.col(i).squaredNorm() - shares.heldOutResidual.col(i).squaredNorm();
      sum += gain;
      square += gain * gain;
      samples += 1.0;
    }
  }
  const double error = std::sqrt(std::fmax(square - sum * sum / samples, 0.0));
  const double noise = measuredOnly(data, data.variance).sum();
  return sum > TableDecision::PredictableDeviations * error &&
    sum > TableDecision::PredictablePart * noise;
}

bool beyondNoise(const GapFigures& gap, double integration)
{
  return gap.rmsBefore >
    TableDecision::UnpredictableFactor * std::sqrt(gap.noiseFloor * gap.noiseFloor + integration);
}

double negligibleEnergy(
  const GapData& data, const Eigen::MatrixXd& after, const Eigen::MatrixXd& integration)
{
  return std::fmax(TableDecision::Integrations * measuredOnly(data, integration).sum(),
    TableDecision::NegligiblePart * after.squaredNorm());
}

bool noticeable(const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
  const Eigen::MatrixXd& integration)
{
  const double left = after.squaredNorm();
  const double explained = before.squaredNorm() - left;
  const Eigen::MatrixXd allowed = TableDecision::Integrations * measuredOnly(data, integration);
  double beyond = 0.0;
  for (Eigen::Index j = 0; j < data.samples(); ++j)
  {
    const double taken = before.col(j).squaredNorm() - after.col(j).squaredNorm();
    beyond += std::fmax(taken - allowed.col(j).sum(), 0.0);
  }
  return explained > TableDecision::NegligiblePart * left &&
    (explained > allowed.sum() || beyond > TableDecision::MostOfIt * explained);
}

bool inFewSamples(const GapData& data, const Eigen::MatrixXd& change)
{
  const Eigen::VectorXd energy = measuredOnly(data, change).colwise().squaredNorm();
  std::vector<double> sorted(energy.data(), energy.data() + energy.size());
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const auto usable = std::count(data.usable.begin(), data.usable.end(), 1);
  const auto few = std::min<std::size_t>(sorted.size(),
    std::max<std::size_t>(
      3, static_cast<std::size_t>(TableDecision::FewSamples * static_cast<double>(usable))));
  double sum = 0.0;
  for (std::size_t i = 0; i < few; ++i)
  {
    sum += sorted[i];
  }
  return sum > TableDecision::NearlyAll * energy.sum();
}

} // namespace msi

#include "Kernels/Gap/Samples/GapEvidence.h"

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Numerics/OrderStatistic.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <vector>

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
  GroupEnergies energies;
  const Eigen::MatrixXd noise = measuredOnly(data, data.variance);
  for (const Eigen::Index i : samples)
  {
    energies.before.push_back(before.col(i).squaredNorm());
    energies.after.push_back(after.col(i).squaredNorm());
    energies.noise.push_back(noise.col(i).sum());
  }
  return energies;
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
  Eigen::MatrixXd left = data.weight.cwiseProduct(before.cwiseAbs2().cwiseMin(after.cwiseAbs2()));
  const Eigen::Index channels = data.channels();
  IndexList elements;
  std::vector<double> relative; // to what is usual in the channel
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    std::vector<double> values;
    for (const Eigen::Index i : data.usable)
    {
      if (data.measured()(k, i))
      {
        elements.push_back(k + channels * i);
        values.push_back(left(k, i));
      }
    }
    if (!values.empty())
    {
      const double usual =
        std::fmax(orderStatistic(values, static_cast<std::ptrdiff_t>(values.size() / 2)), 1.0);
      std::transform(values.begin(), values.end(), std::back_inserter(relative),
        [usual](double value) { return value / usual; });
    }
  }
  const auto vectorOf = [](const std::vector<double>& values)
  {
    return Eigen::Map<const Eigen::VectorXd>(
      values.data(), static_cast<Eigen::Index>(values.size()));
  };
  std::vector<Eigen::Index> oddOfSample(static_cast<std::size_t>(data.samples()), 0);
  IndexList odd;
  for (const Eigen::Index n : oddOnes(vectorOf(relative), data.leftOut.size()))
  {
    odd.push_back(elements[static_cast<std::size_t>(n)]);
    left(odd.back()) = 0.0;
    ++oddOfSample[static_cast<std::size_t>(odd.back() / channels)];
  }
  std::set<Eigen::Index> samples;
  for (const Eigen::Index n : oddOnes(left(Eigen::all, data.usable).colwise().mean().transpose(),
         data.leftOut.size() / static_cast<std::size_t>(channels)))
  {
    samples.insert(data.usable[static_cast<std::size_t>(n)]);
  }
  for (const Eigen::Index i : data.usable)
  {
    if (samples.count(i) > 0 || 4 * oddOfSample[static_cast<std::size_t>(i)] > channels)
    {
      for (Eigen::Index k = 0; k < channels; ++k)
      {
        odd.push_back(k + channels * i);
      }
    }
  }
  std::sort(odd.begin(), odd.end());
  odd.erase(std::unique(odd.begin(), odd.end()), odd.end());
  return odd;
}

bool inFewSamples(const GapData& data, const Eigen::MatrixXd& change)
{
  Eigen::VectorXd energy = measuredOnly(data, change).colwise().squaredNorm();
  std::sort(energy.begin(), energy.end(), std::greater<>());
  return energy.head(std::min(energy.size(), FewSamples)).sum() >
    (1.0 - Decision::SmallPart) * energy.sum();
}

} // namespace msi

#include "Kernels/Estimation/LocalChoice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace msi
{

LocalSamples localSamples(const SampleSet& samples)
{
  LocalSamples local;
  const Eigen::MatrixXd centered = samples.response.colwise() - samples.response.rowwise().mean();
  local.scale =
    (centered.cwiseAbs2().rowwise().mean())
      .cwiseSqrt()
      .unaryExpr([](double deviation) { return deviation > 0.0 ? 1.0 / deviation : 1.0; });
  local.points = local.scale.asDiagonal() * samples.response;
  local.regressors = samples.response;
  local.weights = Eigen::VectorXd::Ones(samples.size());
  local.reflectance = samples.reflectance;
  local.noise = Eigen::VectorXd::Zero(samples.channels());
  local.neighbours = samples.size();
  return local;
}

Eigen::Index neighboursOf(const SampleSet& samples, double part)
{
  constexpr Eigen::Index Fewest = 5;
  const auto wanted =
    static_cast<Eigen::Index>(std::lround(part * static_cast<double>(samples.size())));
  return std::min(std::max(wanted, Fewest), samples.size());
}

LocalSamples withCandidate(
  LocalSamples samples, Eigen::Index chartSamples, const LocalCandidate& candidate)
{
  samples.weights =
    joinedWeights(chartSamples, samples.points.cols() - chartSamples, candidate.tuningWeight);
  samples.neighbours = candidate.neighbours;
  samples.ridge = candidate.ridge;
  return samples;
}

CandidateChoice chooseLocal(const LocalSamples& samples, Eigen::Index chartSamples,
  const SampleSet& tuning, const std::vector<LocalCandidate>& candidates)
{
  CandidateChoice choice;
  choice.leftOutRms = std::numeric_limits<double>::quiet_NaN();
  if (tuning.size() < FewestToChoose)
  {
    return choice;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t candidate = 0; candidate < candidates.size(); ++candidate)
  {
    const LocalSamples local = withCandidate(samples, chartSamples, candidates[candidate]);
    double squares = 0.0;
    for (Eigen::Index i = 0; i < tuning.size(); ++i)
    {
      squares +=
        (localEstimate(local, tuning.response.col(i), chartSamples + i) - tuning.reflectance.col(i))
          .squaredNorm();
    }
    if (squares < least)
    {
      least = squares;
      choice.best = candidate;
    }
  }
  choice.leftOutRms = std::sqrt(least / static_cast<double>(tuning.reflectance.size()));
  choice.chosen = true;
  return choice;
}

} // namespace msi

// Choosing the neighbourhood of a local regression.
#pragma once

#include "Kernels/Estimation/CrossValidation.h"
#include "Kernels/Estimation/LocalEstimator.h"
#include "Kernels/Estimation/SampleSet.h"

#include <vector>

namespace msi
{

struct LocalCandidate
{
  double tuningWeight;
  Eigen::Index neighbours;
  double ridge;
};

// Samples compared by responses divided by each channel's standard deviation (1 for a channel that
// never varies), regressed on their responses without noise; all weights 1, all samples neighbours.
LocalSamples localSamples(const SampleSet& samples);

// That part of the samples, but at least 5 of them where there are so many.
Eigen::Index neighboursOf(const SampleSet& samples, double part);

LocalSamples withCandidate(
  LocalSamples samples, Eigen::Index chartSamples, const LocalCandidate& candidate);

// The candidate with the least squared error of the tuning samples, each left out of the neighbours of
// its own estimate. 'samples' are the chart's, then the tuning samples.
CandidateChoice chooseLocal(const LocalSamples& samples, Eigen::Index chartSamples,
  const SampleSet& tuning, const std::vector<LocalCandidate>& candidates);

} // namespace msi

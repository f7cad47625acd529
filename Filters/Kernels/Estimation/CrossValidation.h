// Choosing hyperparameters by the error on tuning samples that are left out.
#pragma once

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/FitSummary.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <string>

namespace msi
{

// Fewer tuning samples than this choose nothing: methods then take their first candidate.
constexpr Eigen::Index FewestToChoose = 3;

struct CandidateChoice
{
  std::size_t best = 0;
  double leftOutRms = 0.0; // over bands and left-out samples; NaN where nothing was chosen
  bool chosen = false;     // false with fewer than FewestToChoose tuning samples
};

// Estimates the reflectance (N x n) of responses (K x n) with a candidate fitted to 'kept'.
using CandidateEstimate = std::function<Eigen::MatrixXd(
  std::size_t candidate, const SampleSet& kept, const Eigen::MatrixXd& leftOut)>;

// The candidate with the least squared error over tuning samples that took no part in its fit: sample
// i is left out with all samples that equal i modulo the number of folds, which is 8 or the number of
// samples where there are fewer. Of equal candidates the first is taken. There are no random numbers.
CandidateChoice chooseCandidate(
  const SampleSet& tuning, std::size_t candidates, const CandidateEstimate& estimate);

// "chosen on 16 tuning samples, left-out rms 0.0051", or that there were too few.
std::string choiceText(const CandidateChoice& choice, const SampleSet& tuning);

// The summary of a fit whose hyperparameters were chosen so; residualRms is the left-out rms. Not
// complete where there were too few tuning samples to choose.
FitSummary summaryOfChoice(const CandidateChoice& choice, const SampleSet& calibration,
  const SampleSet& tuning, std::string status);

// Throws std::invalid_argument unless both sets are valid and agree in bands and channels.
void requireTrainingSamples(const SampleSet& calibration, const SampleSet& tuning);

// Weights that candidates give a tuning sample beside a chart sample: the same weight, and the same
// say for both sets (L_A / L_T), and their geometric mean.
Eigen::Vector3d tuningWeights(const SampleSet& calibration, const SampleSet& tuning);

// Weights of the joined samples: 1 for the chart's, 'weight' for the tuning samples.
Eigen::VectorXd joinedWeights(Eigen::Index chartSamples, Eigen::Index tuningSamples, double weight);

} // namespace msi

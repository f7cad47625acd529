// Reflectance with its uncertainty on a medium known by a few samples: the method "transfer".
#pragma once

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Estimation/Transfer/TransferEstimator.h"
#include "Kernels/Numerics/FitSummary.h"

namespace msi
{

struct TransferFit
{
  TransferEstimator estimator;
  FitSummary summary;
};

// A mixture of three experts. Two are Gaussian processes, one on responses and reflectances as they
// are, one on their square roots, that learn from the chart and the tuning samples together what the
// media share and in what they differ: a gain and an offset of each channel, and a linear and a
// smooth part of the map from response to reflectance. The third is the diagonal metamerism
// correction (MetamerismCorrection.h), which is hard to beat where camera and media are linear. Documentation/Filters/ReflectanceEstimation.md has the mathematics.
//
// Source:  multi-task Gaussian processes: Bonilla, Chai and Williams, 2007 (NIPS 20); leave-one-out in closed form
//          and marginal likelihood: Rasmussen and Williams, "Gaussian Processes for Machine Learning",
//          2006; the combination, the response correction as part of the fit and the calibration of
//          the uncertainty are this project's.
// Shapes:  calibration N x L_A and K x L_A, tuning N x L_T and K x L_T. Any unit and any gain of a channel:
//          each is divided by its root mean square response over the chart.
// Tuning:  nothing is left to the caller. Hyperparameters maximize the likelihood of the given
//          samples; the mixture and the level of the uncertainty come from leaving out each tuning
//          sample in turn.
// Errors:  std::invalid_argument where a set is empty or not finite, where bands or channels of the
//          sets differ, and for fewer than 2 tuning samples.
// Summary: residualRms is the leave-one-out rms of the tuning samples: what to expect, if slightly
//          optimistic, as hyperparameters are kept. rank: points that carry the posterior of the larger
//          expert; condition is 0 (there is no single system); unknowns: hyperparameters.
// Bytes:   the same samples in the same order give the same estimator on the same machine.
// Cost:    O(min(L_A + L_T, 300)^3) for each of some 100 steps and four times as many of the refits, then O(L m^2) with
//          m <= 256 points for each of 18 posteriors.
// uncertainty: off, nothing is fitted again, and the standard deviation is as optimistic as the left-out errors.
TransferFit fitTransfer(
  const SampleSet& calibration, const SampleSet& tuning, bool uncertainty = true);

} // namespace msi

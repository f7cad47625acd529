// Fits sets of effects to a capture and says how well they predict samples that were left out.
#pragma once

#include "Kernels/Gap/Diagnosis/LinearFit.h"
#include "Kernels/Gap/Samples/EffectSet.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

namespace msi
{

// How far a fit is taken.
struct FitEffort
{
  int iterations;   // at most
  double converged; // part of the error by which an iteration must better it, for another to follow
  // Of no interest with more error than this: a fit that cannot get there any more stops where it is.
  double unwanted = std::numeric_limits<double>::infinity();

  FitEffort unwantedAbove(double error) const noexcept { return { iterations, converged, error }; }
};
constexpr FitEffort SearchFit{ 6, 1e-4 }; // of a set among many
constexpr FitEffort FinalFit{ 20, 1e-5 }; // of one that stays

struct EffectFit
{
  EffectSet set;
  std::vector<FreeParameter> free;
  Eigen::MatrixXd predicted;           // K x S, all samples
  std::vector<Derivative> derivatives; // one a parameter
  LinearFit linear;                    // about the set
  Eigen::ArrayXd root;                 // KS, of the Huber weights
  Eigen::MatrixXd heldOut; // K x S, cross-validated residual of the training samples, 0 elsewhere
  double energy = 0.0;     // weighted sum of squares of heldOut
  double dispersion =
    1.0; // energy a residual element has, with the samples' correlation between channels
};

// LinearFit with Levenberg damping and Huber weights beyond Decision::OutlierDeviations. The estimates without a fold cost no
// further simulation.
class EffectFitter
{
public:
  // Only the samples for training are looked at. Holds a reference to data.
  EffectFitter(const GapData& data, SampleList training, std::uint64_t seed);

  const GapData& data() const noexcept { return Data; }
  const Eigen::MatrixXd& weight() const noexcept { return Weight; }
  const SampleList& training() const noexcept { return Training; }
  double trainingElements() const noexcept { return Elements; }
  double noiseEnergy() const noexcept { return NoiseEnergy; } // what noise alone leaves of energy

  EffectFit nominal() const { return fit({}, SearchFit); }
  EffectFit fit(EffectSet start, const FitEffort& effort) const;
  // What one linear step with one more effect than `present` would leave, with the numbers before it; the other effects act as
  // they did. response: with the present set. None where nothing answers.
  std::optional<EffectFit> oneStep(
    const EffectFit& present, const StagedResponse& response, EffectSet start) const;

  // Covariance of the free parameters: sandwich over samples, whose channels may err together.
  Eigen::MatrixXd covariance(const EffectFit& fit) const;

private:
  // Residuals over their standard deviations, 0 where there is no weight.
  Eigen::ArrayXd whitened(const Eigen::MatrixXd& predicted) const;
  void linearise(EffectFit& fit, const StagedResponse& here, const Eigen::ArrayXd& residual) const;
  // By the normal equations of its derivatives.
  void solve(EffectFit& fit, const Eigen::ArrayXd& residual) const;
  void crossValidate(EffectFit& fit) const;

  const GapData& Data;
  SampleList Training;
  Eigen::MatrixXd Weight;
  std::vector<SampleList> Fold; // the training samples by inner fold
  double Elements = 0.0;
  double NoiseEnergy = 0.0;
};

// Of each fold, by its samples.
// root: of the weights, K x S; residual: times that root, K x S.
std::vector<NormalEquations> normalEquations(const std::vector<Derivative>& derivatives,
  const Eigen::Ref<const Eigen::ArrayXXd>& root, const Eigen::Ref<const Eigen::ArrayXXd>& residual,
  const std::vector<SampleList>& folds);

// Observed minus predicted, K x S; 0 where nothing was measured.
// A step in time is only known to lie between two training samples; a sample between these may lie on either side of it,
// and is taken where it agrees better.
Eigen::MatrixXd leftOfHeldOut(
  const GapData& data, const EffectFit& fit, const SampleList& training);

} // namespace msi

// Fits sets of effects to a capture and says how well they predict samples that were left out.
#pragma once

#include "Kernels/Gap/Diagnosis/LearnedPrior.h"
#include "Kernels/Gap/Samples/EffectSet.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

#include <limits>
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
  Eigen::MatrixXd predicted;   // K x S, all samples
  Eigen::MatrixXd jacobian;    // KS x p
  Eigen::MatrixXd prior;       // p x p, precision: fitPrecision()
  Eigen::MatrixXd information; // p x p, weighted normal matrix with its prior
  Eigen::VectorXd variance;    // p, of the parameters given the data, at unit dispersion
  Eigen::MatrixXd heldOut; // K x S, cross-validated residual of the training samples, 0 elsewhere
  double energy = 0.0;     // weighted sum of squares of heldOut
  double dispersion =
    1.0; // energy a residual element has, with the samples' correlation between channels
  int iterations = 0;

  Eigen::MatrixXd informationOfData() const { return information - prior; }
  std::vector<FreeNumber> numbers() const;
};

// Gauss-Newton with Levenberg damping, bounds by projection, Huber weights beyond
// Decision::OutlierDeviations. Each parameter has a normal prior about neutral (fitPrecision), so that what the data do not
// determine stays neutral. Numbers of single channels beside other effects learn the variance of theirs on the way.
//
// Cross-validation: the estimate without a fold is one Gauss-Newton step from the estimate with it, exact
// for linear effects and to second order in the step else; so folds cost no further simulation.
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

  EffectFit nominal() const;
  EffectFit fit(EffectSet start, const FitEffort& effort) const; // nominal() without effects

  // Covariance of the free parameters: sandwich over samples, whose channels may err together.
  Eigen::MatrixXd covariance(const EffectFit& fit) const;

private:
  void crossValidate(EffectFit& fit) const;

  const GapData& Data;
  SampleList Training;
  Eigen::MatrixXd Weight;
  std::vector<SampleList> Fold; // the training samples by inner fold
  double Elements = 0.0;
  double NoiseEnergy = 0.0;
};

// J^T W J over the samples named, p x p.
// jacobian: KS x p, rows in the order of a K x S response; weight: K x S; free: one a column.
// reach: how many channels away a parameter of one channel acts. Where it is zero the cost grows with the number of
//   parameters a channel has, not with that of all.
Eigen::MatrixXd normalMatrix(const Eigen::MatrixXd& jacobian,
  const Eigen::Ref<const Eigen::ArrayXXd>& weight, const std::vector<FreeParameter>& free,
  Eigen::Index reach, const SampleList& samples);

// Observed minus predicted, K x S; 0 where nothing was measured.
// A step in time is only known to lie between two training samples; a sample between these may lie on either side of it,
// and is taken where it agrees better.
Eigen::MatrixXd leftOfHeldOut(
  const GapData& data, const EffectFit& fit, const SampleList& training);

} // namespace msi

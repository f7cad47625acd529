// Which sets of effects explain the data best: a number for sets of any size, forms and kinds of data, and the search for the best.
#pragma once

#include "Kernels/Gap/Diagnosis/Observation.h"

#include <functional>
#include <vector>

namespace msi
{

// How much about a set of options suggests that they stand for something else: gains in disguise, and effects of a medium that
// are there in every medium.
int signsOfStandIns(const std::vector<GapOption>& options, const std::vector<std::size_t>& set);

// Energies of the channels' gaps without a large gain, of all of them or of each: it has an exact form, and other units or another
// exposure do not make the forms of other effects worse. A gain up to Decision::SmallPart stays as it is, of one far beyond next to
// nothing. Of each channel, the sums of squares of response and gap, and of their products.
Eigen::ArrayXd energiesBesideGain(const Eigen::ArrayXd& response, const Eigen::ArrayXd& product,
  const Eigen::ArrayXd& gap, bool ofChannels);

// How many independent numbers a residual beyond noise is taken to be: `numbers` (Decision::DiscrepancyNumbers or
// BeliefNumbers), or one per group where there are fewer groups; but at least Decision::DiscrepancyPerChannel for each number that
// an effect needs for a channel.
double independentNumbers(double numbers, Eigen::Index groups, Eigen::Index channelNumbers);

// Logarithm of the posterior probability of a set, but for a constant.
//
//   -m/2 log (Q + f G)  -  1/2 log det(1 + prior covariance x information / phi)  -  surprise
//   -  sum of the options' improbabilities
//
// Q: cross-validated energy; G: energy of the gap beyond noise at the nominal camera, without large gains
// (Observation::inexactEnergy); f: Decision::FormPart.
// phi, the dispersion, is what one independent number of the best residual known has of energy: noise, as far as
//   it is coherent within groups, and what is left beyond noise, which counts as independentNumbers().
// m = (Q + f G) / phi of that residual: the independent numbers.
class Criterion
{
public:
  // numbers: Decision::DiscrepancyNumbers, or BeliefNumbers. inexact: Observation::inexactEnergy().
  Criterion(const Observation& data, const ObservedFit& nominal, double numbers, double inexact);

  // The least energy known sets the dispersion. coherence: of its fit.
  void refer(double energy, double coherence);
  double operator()(const ObservedFit& fit) const;

  double gapEnergy() const noexcept { return Gap; }

private:
  double improbability(const std::vector<std::size_t>& set) const;
  double occam(const ObservedFit& fit) const;

  const Observation& Data;
  double Gap = 0.0;
  double Noise = 0.0;
  double Floor = 0.0;
  double Discrepancy = 1.0;
  double Reference = 0.0;
  double Dispersion = 1.0;
  double Numbers = 1.0;
};

struct SetSearchLimits
{
  int maximumEffects = 5;
  std::size_t beamWidth = 3;      // sets of each size that are kept on the way
  std::size_t optionsFitted = 10; // in full, for each of them
  bool exchange = true;
};

struct FoundSets
{
  FitPointer nominal, best;
  std::vector<FitPointer> visited; // every set that was fitted, of each only the likeliest form
  std::vector<double> score;       // of each, by the final criterion
  std::vector<double> belief;      // of each, by the criterion with Decision::BeliefNumbers
  double gapEnergy = 0.0;
  double inexactEnergy = 0.0; // Observation::inexactEnergy() of the last search
};

// Beam search by size, then exchanges and removals of one or two effects and other forms of each, until none makes the set likelier.
// Once more without large gains of channels in Observation::inexactEnergy() where they are in the set.
// stop() is asked now and then; true ends the search early.
FoundSets searchSets(
  const Observation& data, const SetSearchLimits& limits, const std::function<bool()>& stop);

} // namespace msi

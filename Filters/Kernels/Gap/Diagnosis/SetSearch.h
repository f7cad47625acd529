// Which sets of effects explain the data best.
#pragma once

#include "Kernels/Gap/Diagnosis/Criterion.h"

#include <functional>
#include <vector>

namespace msi
{

struct SetSearchLimits
{
  int maximumEffects = 5;
  int beamWidth = 3;      // sets of each size that are kept on the way
  int optionsFitted = 10; // in full, for each of them
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

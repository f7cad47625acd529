// Effects fitted to the normal equations of an image pair's blocks.
#pragma once

#include "Kernels/Gap/Diagnosis/LinearFit.h"
#include "Kernels/Gap/Field/FieldEffects.h"
#include "Kernels/Gap/Field/FieldStatistics.h"

#include <Eigen/Core>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

using FieldShape = std::map<ImageParameter, double>;

struct FieldFit
{
  FieldModel next;     // what one Gauss-Newton step from the statistics' model gives
  double step = 0.0;   // largest change, in typical sizes
  double energy = 0.0; // cross-validated, weighted
  // What the steps without a fold change in the columns; fold, K.
  std::vector<std::vector<Eigen::VectorXd>> change;
  LinearFit linear;         // of the set's numbers
  Eigen::VectorXd increase; // of these in the step
};

// Cross-validated energy of each block; 0 for test blocks.
Eigen::VectorXd blockEnergies(
  const FieldData& data, const FieldStatistics& statistics, const FieldFit& fit);

// Everything that linear algebra needs from one set of statistics.
class FieldFitter
{
public:
  // Holds references.
  FieldFitter(const FieldData& data, const FieldStatistics& statistics);

  // The effects of `set` free; every other effect of the model is taken back to neutral.
  // start: numbers of effects that the model does not have yet, where they are to start from.
  FieldFit fit(const FieldSet& set, const FieldShape& start = {}) const;
  // Effects that the model does not have yet start from the best of their starts (ImageTerm::starts).
  FieldFit fitFromBestStart(const FieldSet& set) const;

  // Weighted energy of the training blocks at the model itself.
  double energy() const noexcept { return Energy; }
  // Sums of BlockSums::normal() over the training blocks: of each fold those of the channels.
  const std::vector<std::vector<Eigen::MatrixXd>>& folds() const noexcept { return Fold; }

  // Standard deviation of each number of the set.
  Eigen::VectorXd standardErrors(const FieldSet& set, const FieldFit& fit) const;

private:
  // Of a channel: the numbers that act in it, and what each changes in its columns.
  struct Design;
  std::vector<Design> designs(
    const std::vector<FieldNumber>& numbers, const FieldModel& about) const;

  const FieldData& Data;
  const FieldStatistics& Statistics;
  std::vector<std::vector<Eigen::MatrixXd>> Fold; // fold, K
  double Energy = 0.0;
};

// A set of effects fitted in full.
struct FieldHypothesis
{
  FieldSet set;
  std::shared_ptr<const FieldStatistics> statistics; // with the columns of the set, or all
  FieldFit fit;
};

// The model after Gauss-Newton from a start.
FieldHypothesis refitted(
  const FieldData& data, const FieldWeights& weights, const FieldSet& set, const FieldModel& start);

} // namespace msi

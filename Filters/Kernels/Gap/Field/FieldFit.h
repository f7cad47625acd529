// Effects fitted to the normal equations of an image pair's blocks.
#pragma once

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

  // The effects of `set` free; every other effect of the model is taken back to neutral. Bounds by fixing what is
  // beyond. The prior is that of fitPrecision(). The estimate without a fold comes from
  // the normal equations without it: exact where the model is linear.
  // start: numbers of effects that the model does not have yet, where they are to start from.
  FieldFit fit(const FieldSet& set, const FieldShape& start = {}) const;
  // Effects that the model does not have yet start from the best of their starts (ImageTerm::starts).
  FieldFit fitFromBestStart(const FieldSet& set) const;

  // Weighted energy of the training blocks at the model itself, and what noise allows of it.
  double energy() const noexcept { return Energy; }
  double chance() const noexcept { return Chance; }
  // Sums of BlockSums::normal() over the training blocks: of each fold those of the channels.
  const std::vector<std::vector<Eigen::MatrixXd>>& folds() const noexcept { return Fold; }

  // Standard deviation of each number of the set. Sandwich over groups of blocks.
  Eigen::VectorXd standardErrors(const FieldSet& set) const;

  // Normal matrix of the numbers in the same order, without their priors.
  Eigen::MatrixXd information(const FieldSet& set) const;

private:
  struct Bound;
  struct Design;
  std::vector<Design> designs(
    const std::vector<FieldNumber>& numbers, const FieldModel& about) const;
  Eigen::VectorXd solve(const std::vector<Eigen::MatrixXd>& normal,
    const std::vector<Design>& design, const std::vector<Bound>& bounds,
    const Eigen::MatrixXd& prior) const;
  // Precision of the numbers of the set, which come first, and of those that are held.
  Eigen::MatrixXd priorOf(const FieldSet& set, const std::vector<Bound>& bounds) const;

  const FieldData& Data;
  const FieldStatistics& Statistics;
  std::vector<Eigen::MatrixXd> Total;             // K
  std::vector<std::vector<Eigen::MatrixXd>> Fold; // fold, K
  double Energy = 0.0;
  double Chance = 0.0;
};

// A set of effects fitted in full.
struct FieldHypothesis
{
  FieldSet set;
  std::shared_ptr<const FieldStatistics> statistics; // with the columns of the set, or all
  FieldFit fit;
};

// The model after Gauss-Newton from a start.
FieldHypothesis refitted(const FieldData& data, const FieldWeights& weights, const FieldSet& set,
  const FieldModel& start, const FieldLoop& loop);

} // namespace msi

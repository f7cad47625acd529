// Effects fitted to the normal equations of an image pair's blocks.
#pragma once

#include "Kernels/Gap/Field/FieldEffects.h"
#include "Kernels/Gap/Field/FieldStatistics.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace msi
{

enum class FieldDetail
{
  Sum, // without FieldFit::blockEnergy, a tenth of the time
  Blocks
};

using FieldShape = std::map<ImageParameter, double>;

struct FieldFit
{
  FieldSet set;
  FieldModel next;             // what one Gauss-Newton step from the statistics' model gives
  double step = 0.0;           // largest change, in typical sizes
  Eigen::VectorXd blockEnergy; // cross-validated, weighted; 0 for test blocks
  double energy = 0.0;         // its sum
};

// Least squares in which the numbers of a channel meet only each other and those common to all channels.
struct ArrowEquations
{
  Eigen::MatrixXd common;
  Eigen::VectorXd gradient; // of the common numbers
  // Of each channel; across: own x common.
  std::vector<Eigen::MatrixXd> own, across;
  std::vector<Eigen::VectorXd> ownGradient;
};
struct ArrowSolution
{
  Eigen::VectorXd common;
  std::vector<Eigen::VectorXd> own;
};
// Eliminates the channels one by one, then solves for the common numbers.
ArrowSolution solved(ArrowEquations equations);

// Everything that linear algebra needs from one set of statistics.
class FieldFitter
{
public:
  // Holds references.
  FieldFitter(const FieldData& data, const FieldStatistics& statistics);

  const FieldStatistics& statistics() const noexcept { return Statistics; }

  // The effects of `set` free; every other effect of the model is taken back to neutral. Bounds by fixing what is
  // beyond. Each parameter has a prior of ten times its typical size. The estimate without a fold comes from
  // the normal equations without it: exact where the model is linear.
  // start: numbers of effects that the model does not have yet, where they are to start from.
  FieldFit fit(const FieldSet& set, const FieldShape& start = {},
    FieldDetail detail = FieldDetail::Blocks) const;

  // Weighted energy of the training blocks at the model itself, and what noise allows of it.
  double energy() const noexcept { return Energy; }
  double chance() const noexcept { return Chance; }

  // Standard deviation of each parameter of the set, terms in order, channels within a per-channel term.
  // Sandwich over groups of blocks.
  Eigen::VectorXd standardErrors(const FieldSet& set) const;

  // Normal matrix of the numbers in the same order, without their priors.
  Eigen::MatrixXd information(const FieldSet& set) const;

private:
  struct Bound;
  std::vector<Eigen::MatrixXd> design(const FieldSet& set) const;
  std::vector<Eigen::VectorXd> solve(const std::vector<Eigen::MatrixXd>& normal,
    const std::vector<Bound>& terms, std::vector<Eigen::ArrayXd>& values,
    const FieldModel& about) const;

  const FieldData& Data;
  const FieldStatistics& Statistics;
  Eigen::ArrayXd Glare;
  std::vector<Eigen::MatrixXd> Total;             // K
  std::vector<std::vector<Eigen::MatrixXd>> Fold; // fold, K
  double Energy = 0.0;
  double Chance = 0.0;
};

} // namespace msi

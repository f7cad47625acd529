// A set's free numbers fitted to normal equations of data in folds: what tables and image pairs have in common once their
// residuals are linear in the numbers.
#pragma once

#include "Kernels/Gap/Diagnosis/LearnedPrior.h"
#include "Kernels/Gap/Diagnosis/Observation.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

// Of weighted residuals r about some values of the numbers that would change them by -J: J'J and J'r. Sparse: numbers of
// different channels mostly have nothing to do with each other.
struct NormalEquations
{
  SparseMatrix matrix;
  Eigen::VectorXd gradient;
};

class NormalEquationsSum
{
public:
  explicit NormalEquationsSum(Eigen::Index count)
    : Gradient(Eigen::VectorXd::Zero(count))
  {
  }
  // numbers: those that these are about.
  void add(const std::vector<Eigen::Index>& numbers, const Eigen::MatrixXd& matrix,
    const Eigen::VectorXd& gradient);
  NormalEquations sum() const;

private:
  std::vector<Eigen::Triplet<double>> Entries;
  Eigen::VectorXd Gradient;
};

// A penalised Gauss-Newton step.
//
// Prior: normal about FreeNumber::wanted, by fitPrior(). Numbers of single channels learn their variance
//   where another effect is in the set, so that these keep to what the channels do not have in common.
// Bounds: a number that would pass one is held there, and the others are solved for again.
// The data count less the more is left: their precision is that of noise over the dispersion.
// The estimate without a fold comes from the normal equations without it: exact where the residuals are linear.
class LinearFit
{
public:
  LinearFit() = default;
  // folds: equations of each, about the numbers' deviations. besideOthers: whether the set has several effects. dispersion: variance
  // of a weighted residual, by which the data count less beside the prior.
  LinearFit(std::vector<FreeNumber> numbers, std::vector<NormalEquations> folds, bool besideOthers,
    double dispersion = 1.0);

  // damping: part by which the diagonal is larger (Levenberg and Marquardt).
  Eigen::VectorXd step(double damping = 0.0) const;
  // Without each fold.
  std::vector<Eigen::VectorXd> stepsWithout() const;
  // The fit goes no further: from here on step() is none, and stepsWithout() what leaving out the fold alone does.
  void settle();
  // Twice the prior's minus logarithm after a step.
  double penalty(const Eigen::VectorXd& step) const;

  // Of the numbers, by a sandwich over groups. scores: a column a group, J'r of its residuals held out.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& scores) const;

  // Everything but set, energy and coherence: of the numbers here, or after a step.
  void describe(ObservedFit& fit, const Eigen::VectorXd& step) const;
  void describe(ObservedFit& fit) const { describe(fit, Eigen::VectorXd::Zero(Off.size())); }

  SparseMatrix information() const { return Dispersion * All.matrix; } // without prior
  const BlockPrior& prior() const noexcept { return Prior; }

private:
  // factor: of the first of several steps, whose pattern it keeps.
  Eigen::VectorXd step(
    const NormalEquations& equations, double damping, SparseFactor& factor) const;
  std::vector<FreeNumber> withVariance() const;

  std::vector<FreeNumber> Numbers;
  std::vector<NormalEquations> Folds;
  NormalEquations All;
  BlockPrior Prior;
  double Dispersion = 1.0;
  Eigen::VectorXd Off; // from the number to what its prior wants
};

} // namespace msi

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

// Of weighted residuals r about some values of the numbers that would change them by -J: J'J and J'r.
struct NormalEquations
{
  explicit NormalEquations(Eigen::Index count = 0)
    : matrix(Eigen::MatrixXd::Zero(count, count))
    , gradient(Eigen::VectorXd::Zero(count))
  {
  }

  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
};

// A penalised Gauss-Newton step.
//
// Prior: normal about FreeNumber::wanted, with the precision fitPrecision(). Numbers of single channels learn their variance
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
  Eigen::VectorXd step(double damping = 0.0) const { return step(All, damping); }
  Eigen::VectorXd stepWithout(std::size_t fold) const;
  std::size_t folds() const noexcept { return Folds.size(); }
  // The fit goes no further: from here on step() is none, and stepWithout() what leaving out the fold alone does.
  void settle();
  // Twice the prior's minus logarithm after a step.
  double penalty(const Eigen::VectorXd& step) const;

  // Of the numbers, by a sandwich over groups. scores: a column a group, J'r of its residuals held out.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& scores) const;

  // Everything but set, energy and coherence: of the numbers here, or after a step.
  void describe(ObservedFit& fit, const Eigen::VectorXd& step) const;
  void describe(ObservedFit& fit) const { describe(fit, Eigen::VectorXd::Zero(Off.size())); }

  Eigen::MatrixXd information() const { return Dispersion * All.matrix; } // without prior
  const Eigen::MatrixXd& precision() const noexcept { return Precision; } // of the prior

private:
  Eigen::VectorXd step(NormalEquations equations, double damping) const;
  std::vector<FreeNumber> withVariance() const;

  std::vector<FreeNumber> Numbers;
  std::vector<NormalEquations> Folds;
  NormalEquations All;
  Eigen::MatrixXd Precision;
  double Dispersion = 1.0;
  Eigen::VectorXd Off; // from the number to what its prior wants
};

} // namespace msi

// The free numbers of a set of effects: what they look like before the data speak, where the scatter over channels is learned, and their
// fit to normal equations of data in folds, which tables and image pairs have in common once their residuals are linear in the numbers.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <cstddef>
#include <limits>
#include <vector>

namespace msi
{

class ObservedFit;

// Probability that independent normal deviations of the channels have as large a part of their energy, or a larger one, in a polynomial
// over the channels with half as many coefficients as there are channels, at most four: a cubic, or a line or one number for all where
// channels are few. What a smooth change of the light does to them. The upper tail of a Beta distribution; 1 for one channel.
double chanceOfCurve(const Eigen::VectorXd& deviations);

struct FreeNumber
{
  std::size_t group = 0; // numbers of one group stand together and differ in the channel only
  bool perChannel = false;
  bool ownMean = false;   // of channels: the effect also has a form with one number for all
  double deviation = 0.0; // from neutral
  double typical = 1.0;   // size
  double variance = 0.0;  // of the deviation, once the data have spoken
  // Ends of its range, and the middle of its prior in a fit; from neutral.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double wanted = 0.0;
  bool normal = false; // of a common number known to be near neutral: its prior is not Cauchy
  // Of numbers of channels: they tell the effect also where they follow a curve over the channels. A pattern in the image does, or
  // the light makes them what they are.
  bool mayFollowCurve = false;
  bool mayEnd = false; // it serves the fit alone: the end of its range tells nothing
};

// Of a number that a fit leaves neutral only where the data do not determine it: Decision::FreeSpread typical sizes, squared.
double wideVariance(double typical) noexcept;

using SparseMatrix = Eigen::SparseMatrix<double>;
using SparseFactor = Eigen::SimplicialLDLT<SparseMatrix>;

double logDeterminant(const SparseFactor& factor);

// Of the inverse of a symmetric matrix, whose other elements are not worked out (K. Takahashi, J. Fagan and M.-S. Chin, 1973).
Eigen::VectorXd diagonalOfInverse(const SparseMatrix& matrix);

// So many numbers, independent with this variance about a mean: neutral, or where it has a variance a number of its own.
struct PriorBlock
{
  Eigen::Index size = 1;
  double variance = 1.0;
  double ofMean = 0.0;
};

// A normal prior of numbers, block by block. With means it is dense, unless these are carried along: behind the numbers.
class BlockPrior
{
public:
  BlockPrior() = default;
  explicit BlockPrior(std::vector<PriorBlock> blocks);

  const std::vector<PriorBlock>& blocks() const noexcept { return Blocks; }
  // Precision of numbers and means after data with this normal matrix of the numbers.
  SparseMatrix after(SparseMatrix normal) const;
  // Precision of the numbers alone, times this.
  Eigen::VectorXd pull(const Eigen::VectorXd& off) const;
  // 1/2 log det(1 + covariance x normal): nats that such data tell of the numbers.
  double gain(const SparseMatrix& normal) const;

private:
  std::vector<PriorBlock> Blocks;
  SparseMatrix Precision;
};

// The prior of a fit: wideVariance() for a common number; for numbers of single channels that are no longer neutral the
// variance learned from them, so that a common effect beside them takes what they have in common.
BlockPrior fitPrior(const std::vector<FreeNumber>& numbers);

// The prior by which a fit is judged.
//   A common number: a Cauchy distribution whose scale is the typical size (H. Jeffreys, Theory of Probability, 1961, 5.2).
//   Numbers of single channels: normal, their variance learned from them by a step of expectation and maximization; and, where
//   `ownMean`, a mean with the prior of a common number.
struct LearnedPrior
{
  explicit LearnedPrior(const std::vector<FreeNumber>& numbers);

  BlockPrior distribution; // a common number with the square of the scale
  // Minus the logarithm of the prior's density over that at neutral.
  double surprise = 0.0;
  // Probability that independent numbers of channels follow a smooth curve over the channels as closely; the smallest of
  // all groups, but for those mayFollowCurve.
  double chanceOfCurve = 1.0;
};

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

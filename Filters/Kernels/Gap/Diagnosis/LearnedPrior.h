// What the free numbers of a set of effects look like before the data speak; the scatter over channels is learned.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <cstddef>
#include <limits>
#include <vector>

namespace msi
{

// Probability that fixed directions, half as many as there are channels and at most four, hold the part `fraction` or more of the
// energy of independent normal deviations of the channels: the upper tail of a Beta distribution. 1 for one channel.
double chanceOfFraction(double fraction, Eigen::Index channels);

// The part of the deviations' energy in a polynomial over the channels with so many coefficients: a cubic, or a line or one number for
// all where channels are few. What a smooth change of the light does to them.
double commonFraction(const Eigen::VectorXd& deviations);

// Probability that independent normal deviations have that part there, or more.
double chanceOfCurve(const Eigen::VectorXd& deviations);

struct FreeNumber
{
  std::size_t group = 0; // numbers of one group stand together and differ in the channel only
  bool perChannel = false;
  bool ownMean =
    false; // of numbers of channels: the effect also has a form with one number for all of them
  double deviation = 0.0; // from neutral
  double typical = 1.0;   // size
  double variance = 0.0;  // of the deviation, once the data have spoken
  // Ends of its range, and the middle of its prior in a fit; from neutral.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double wanted = 0.0;
  bool normal =
    false; // of a common number: known to be near neutral, its prior is normal and not Cauchy
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

} // namespace msi

#include "Kernels/Gap/Diagnosis/LearnedPrior.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <Eigen/QR>
#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double LeastDeviation = 1e-6; // of the typical size
constexpr double Jitter =
  1e-12; // so much more precise a number that does what others do keeps a pivot
}

namespace
{
Eigen::Index directionsOf(Eigen::Index channels)
{
  return std::clamp<Eigen::Index>(channels / 2, 1, 4);
}
}

double chanceOfFraction(double fraction, Eigen::Index channels)
{
  if (channels < 2)
  {
    return 1.0;
  }
  const auto directions = static_cast<double>(directionsOf(channels));
  return Eigen::numext::betainc(0.5 * (static_cast<double>(channels) - directions),
    0.5 * directions, std::clamp(1.0 - fraction, 0.0, 1.0));
}

double commonFraction(const Eigen::VectorXd& deviations)
{
  const Eigen::Index channels = deviations.size();
  const double energy = deviations.squaredNorm();
  if (channels < 2 || !(energy > 0.0))
  {
    return 0.0;
  }
  const Eigen::Index directions = directionsOf(channels);
  Eigen::MatrixXd basis(channels, directions);
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(channels, -1.0, 1.0);
  for (Eigen::Index power = 0; power < directions; ++power)
  {
    basis.col(power) = x.pow(static_cast<double>(power)).matrix();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(channels, directions);
  return std::min((q.transpose() * deviations).squaredNorm() / energy, 1.0);
}

double chanceOfCurve(const Eigen::VectorXd& deviations)
{
  return chanceOfFraction(commonFraction(deviations), deviations.size());
}

namespace
{
double squareOf(double value)
{
  return value * value;
}

// Numbers of one group.
struct Group
{
  Eigen::Index size;
  FreeNumber kind;          // of the first number
  Eigen::ArrayXd deviation; // from neutral; with a mean of their own from that
  double learned = 0.0;     // variance of numbers of single channels
  double mean = 0.0;        // from neutral, of those with a mean of their own

  // Of numbers of single channels, whose mean has this variance where it is their own.
  PriorBlock block(double ofMean) const { return { size, learned, kind.ownMean ? ofMean : 0.0 }; }
};

std::vector<Group> groupsOf(const std::vector<FreeNumber>& numbers)
{
  std::vector<Group> groups;
  const auto count = static_cast<Eigen::Index>(numbers.size());
  const auto at = [&numbers](Eigen::Index n) -> const FreeNumber&
  { return numbers[static_cast<std::size_t>(n)]; };
  for (Eigen::Index first = 0; first < count; first += groups.back().size)
  {
    Group group{ 1, at(first), {} };
    while (first + group.size < count && at(first + group.size).group == group.kind.group)
    {
      ++group.size;
    }
    group.deviation.resize(group.size);
    double variance = 0.0;
    for (Eigen::Index p = 0; p < group.size; ++p)
    {
      group.deviation[p] = at(first + p).deviation;
      variance += at(first + p).variance / static_cast<double>(group.size);
    }
    const double widest = wideVariance(group.kind.typical);
    const bool ownMean = group.kind.perChannel && group.kind.ownMean;
    const bool isNeutral = (group.deviation == 0.0).all();
    group.mean = ownMean ? group.deviation.mean() : 0.0;
    group.deviation -= group.mean;
    group.learned = isNeutral ? widest
                              : std::fmin(group.deviation.square().mean() + variance +
                                    squareOf(LeastDeviation * group.kind.typical),
                                  widest);
    groups.push_back(std::move(group));
  }
  return groups;
}
}

double wideVariance(double typical) noexcept
{
  return squareOf(Decision::FreeSpread * typical);
}

double logDeterminant(const SparseFactor& factor)
{
  return factor.vectorD().array().log().sum();
}

Eigen::VectorXd diagonalOfInverse(const SparseMatrix& matrix)
{
  const SparseFactor factor(matrix);
  const SparseMatrix& lower = factor.matrixL().nestedExpression(); // without the ones
  using Entry = SparseMatrix::InnerIterator;
  // By columns from the last one on, and only where the factor has an element.
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
  for (Eigen::Index j = matrix.cols(); j-- > 0;)
  {
    inverse(j, j) = 1.0 / factor.vectorD()[j];
    for (Entry row(lower, j); row; ++row)
    {
      for (Entry other(lower, j); other; ++other)
      {
        inverse(row.row(), j) -= other.value() *
          inverse(std::max(row.row(), other.row()), std::min(row.row(), other.row()));
      }
    }
    for (Entry row(lower, j); row; ++row)
    {
      inverse(j, j) -= row.value() * inverse(row.row(), j);
    }
  }
  return factor.permutationPinv() * Eigen::VectorXd(inverse.diagonal());
}

BlockPrior::BlockPrior(std::vector<PriorBlock> blocks)
  : Blocks(std::move(blocks))
{
  Eigen::Index numbers = 0;
  Eigen::Index all = 0;
  for (const PriorBlock& block : Blocks)
  {
    numbers += block.size;
    all += block.size + (block.ofMean > 0.0 ? 1 : 0);
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index number = 0;
  Eigen::Index mean = numbers;
  for (const PriorBlock& block : Blocks)
  {
    const bool hasMean = block.ofMean > 0.0;
    for (const Eigen::Index end = number + block.size; number < end; ++number)
    {
      entries.emplace_back(number, number, 1.0 / block.variance);
      if (hasMean)
      {
        entries.emplace_back(number, mean, -1.0 / block.variance);
        entries.emplace_back(mean, number, -1.0 / block.variance);
      }
    }
    if (hasMean)
    {
      entries.emplace_back(
        mean, mean, static_cast<double>(block.size) / block.variance + 1.0 / block.ofMean);
      ++mean;
    }
  }
  Precision.resize(all, all);
  Precision.setFromTriplets(entries.begin(), entries.end());
}

SparseMatrix BlockPrior::after(SparseMatrix normal) const
{
  normal.conservativeResize(Precision.rows(), Precision.cols());
  normal += Precision;
  normal.diagonal() *= 1.0 + Jitter;
  return normal;
}

Eigen::VectorXd BlockPrior::pull(const Eigen::VectorXd& off) const
{
  Eigen::VectorXd pull(off.size());
  Eigen::Index first = 0;
  for (const PriorBlock& block : Blocks)
  {
    const auto own = off.segment(first, block.size).array();
    const double mean =
      own.sum() * block.ofMean / (block.variance + static_cast<double>(block.size) * block.ofMean);
    pull.segment(first, block.size) = (own - mean) / block.variance;
    first += block.size;
  }
  return pull;
}

double BlockPrior::gain(const SparseMatrix& normal) const
{
  if (Blocks.empty())
  {
    return 0.0;
  }
  // Of the determinant without data means of their own are a factor of 1 / ofMean.
  double logs = logDeterminant(SparseFactor(after(normal)));
  for (const PriorBlock& block : Blocks)
  {
    logs += static_cast<double>(block.size) * std::log(block.variance) +
      (block.ofMean > 0.0 ? std::log(block.ofMean) : 0.0);
  }
  return 0.5 * logs;
}

BlockPrior fitPrior(const std::vector<FreeNumber>& numbers)
{
  std::vector<PriorBlock> blocks;
  for (const Group& group : groupsOf(numbers))
  {
    const double wide = wideVariance(group.kind.typical);
    blocks.push_back(group.kind.perChannel ? group.block(wide) : PriorBlock{ group.size, wide });
  }
  return BlockPrior(std::move(blocks));
}

LearnedPrior::LearnedPrior(const std::vector<FreeNumber>& numbers)
{
  std::vector<PriorBlock> blocks;
  for (const Group& group : groupsOf(numbers))
  {
    const double square = squareOf(group.kind.typical);
    const auto cauchy = [&](double value) { return std::log1p(value * value / square); };
    if (group.kind.perChannel)
    {
      blocks.push_back(group.block(square));
      surprise += 0.5 * group.deviation.square().sum() / group.learned + cauchy(group.mean);
      if (!group.kind.mayFollowCurve)
      {
        chanceOfCurve = std::fmin(chanceOfCurve, msi::chanceOfCurve(group.deviation.matrix()));
      }
    }
    else
    {
      blocks.push_back({ group.size, square });
      surprise += group.kind.normal ? 0.5 * group.deviation.square().sum() / square
                                    : group.deviation.unaryExpr(cauchy).sum();
    }
  }
  distribution = BlockPrior(std::move(blocks));
}

} // namespace msi

#include "Kernels/Gap/Diagnosis/LinearFit.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/Observation.h"

#include <Eigen/QR>
#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>
#include <utility>

namespace msi
{

namespace
{
constexpr double LeastDeviation = 1e-6; // of the typical size
constexpr double Jitter =
  1e-12; // so much more precise a number that does what others do keeps a pivot

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
  const Eigen::Index count = numbers.size();
  const auto at = [&numbers](Eigen::Index n) -> const FreeNumber& { return numbers[n]; };
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

constexpr int Rounds = 3;         // of holding numbers at their bounds
constexpr int Learnings = 3;      // of expectation and maximization
constexpr double Rounding = 1e-9; // typical sizes

bool anyPerChannel(const std::vector<FreeNumber>& numbers)
{
  return std::any_of(
    numbers.begin(), numbers.end(), [](const FreeNumber& number) { return number.perChannel; });
}

// Leaves the equations with these unknowns 0.
void hold(SparseMatrix& matrix, Eigen::VectorXd& right, const std::vector<char>& held)
{
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
  {
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
    {
      if (held[entry.row()] != 0 || held[column] != 0)
      {
        entry.valueRef() = entry.row() == column ? 1.0 : 0.0;
      }
    }
    right[column] = held[column] != 0 ? 0.0 : right[column];
  }
}
}

double chanceOfCurve(const Eigen::VectorXd& deviations)
{
  const Eigen::Index channels = deviations.size();
  const double energy = deviations.squaredNorm();
  if (channels < 2 || !(energy > 0.0))
  {
    return 1.0;
  }
  const Eigen::Index directions = std::clamp<Eigen::Index>(channels / 2, 1, 4);
  Eigen::MatrixXd basis(channels, directions);
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(channels, -1.0, 1.0);
  for (Eigen::Index power = 0; power < directions; ++power)
  {
    basis.col(power) = x.pow(static_cast<double>(power)).matrix();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(channels, directions);
  const double beside = 1.0 - (q.transpose() * deviations).squaredNorm() / energy;
  return Eigen::numext::betainc(0.5 * static_cast<double>(channels - directions),
    0.5 * static_cast<double>(directions), std::fmax(beside, 0.0));
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

void NormalEquationsSum::add(const std::vector<Eigen::Index>& numbers,
  const Eigen::MatrixXd& matrix, const Eigen::VectorXd& gradient)
{
  for (std::size_t column = 0; column < numbers.size(); ++column)
  {
    for (std::size_t row = 0; row < numbers.size(); ++row)
    {
      Entries.emplace_back(numbers[row], numbers[column], matrix(row, column));
    }
    Gradient[numbers[column]] += gradient[column];
  }
}

NormalEquations NormalEquationsSum::sum() const
{
  NormalEquations sum{ SparseMatrix(Gradient.size(), Gradient.size()), Gradient };
  sum.matrix.setFromTriplets(Entries.begin(), Entries.end());
  return sum;
}

LinearFit::LinearFit(std::vector<FreeNumber> numbers, std::vector<NormalEquations> folds,
  bool besideOthers, double dispersion)
  : Numbers(std::move(numbers))
  , Folds(std::move(folds))
  , Dispersion(dispersion)
  , Off(Numbers.size())
{
  All = { SparseMatrix(Off.size(), Off.size()), Eigen::VectorXd::Zero(Off.size()) };
  for (NormalEquations& fold : Folds)
  {
    fold.matrix /= Dispersion;
    fold.gradient /= Dispersion;
    All.matrix += fold.matrix;
    All.gradient += fold.gradient;
  }
  std::vector<PriorBlock> wide;
  for (Eigen::Index n = 0; n < Off.size(); ++n)
  {
    const FreeNumber& number = Numbers[n];
    wide.push_back({ 1, wideVariance(number.typical) });
    Off[n] = number.wanted - number.deviation;
  }
  Prior = BlockPrior(std::move(wide));
  const bool learns = besideOthers && anyPerChannel(Numbers);
  for (int round = 0; learns && round < Learnings; ++round)
  {
    Prior = fitPrior(withVariance());
  }
}

std::vector<FreeNumber> LinearFit::withVariance() const
{
  std::vector<FreeNumber> numbers = Numbers;
  if (anyPerChannel(numbers))
  {
    const Eigen::VectorXd variance = diagonalOfInverse(Prior.after(All.matrix));
    for (std::size_t n = 0; n < numbers.size(); ++n)
    {
      numbers[n].variance = variance[n];
    }
  }
  return numbers;
}

Eigen::VectorXd LinearFit::step(double damping) const
{
  SparseFactor factor;
  return step(All, damping, factor);
}

std::vector<Eigen::VectorXd> LinearFit::stepsWithout() const
{
  SparseFactor factor;
  std::vector<Eigen::VectorXd> steps;
  for (const NormalEquations& fold : Folds)
  {
    steps.push_back(step({ All.matrix - fold.matrix, All.gradient - fold.gradient }, 0.0, factor));
  }
  return steps;
}

Eigen::VectorXd LinearFit::step(
  const NormalEquations& equations, double damping, SparseFactor& factor) const
{
  const Eigen::Index count = Off.size();
  if (count == 0)
  {
    return Off;
  }
  SparseMatrix matrix = Prior.after(equations.matrix);
  matrix.diagonal() *= 1.0 + damping;
  if (factor.rows() == 0)
  {
    factor.analyzePattern(matrix);
  }
  const Eigen::VectorXd gradient = equations.gradient + Prior.pull(Off);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(matrix.rows()); // means behind the numbers
  std::vector<char> held(matrix.rows(), 0);
  for (int round = 0; round < Rounds; ++round)
  {
    Eigen::VectorXd left = -(matrix * step);
    left.head(count) += gradient;
    SparseMatrix others = matrix;
    hold(others, left, held);
    factor.factorize(others);
    step += factor.solve(left);
    bool beyond = false;
    for (Eigen::Index n = 0; n < count; ++n)
    {
      const FreeNumber& number = Numbers[n];
      const double within =
        std::clamp(step[n], number.lower - number.deviation, number.upper - number.deviation);
      if (std::exchange(step[n], within) != within)
      {
        held[n] = 1;
        beyond = true;
      }
    }
    if (!beyond)
    {
      break;
    }
  }
  return step.head(count);
}

void LinearFit::settle()
{
  All.gradient = -Prior.pull(Off);
}

double LinearFit::penalty(const Eigen::VectorXd& step) const
{
  const Eigen::VectorXd off = step - Off;
  return Dispersion * off.dot(Prior.pull(off));
}

Eigen::MatrixXd LinearFit::covariance(const Eigen::MatrixXd& scores) const
{
  const auto groups = static_cast<double>(scores.cols());
  const SparseMatrix precision = Prior.after(All.matrix);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(precision.rows(), scores.cols());
  right.topRows(scores.rows()) = scores / Dispersion;
  const Eigen::MatrixXd half = SparseFactor(precision).solve(right).topRows(scores.rows());
  return groups / std::max(groups - 1.0, 1.0) * half * half.transpose();
}

void LinearFit::describe(ObservedFit& fit, const Eigen::VectorXd& step) const
{
  std::vector<FreeNumber> moved = withVariance();
  for (std::size_t n = 0; n < moved.size(); ++n)
  {
    FreeNumber& number = moved[n];
    number.deviation += step[n];
    const double rounding = Rounding * number.typical;
    // An end that is neutral is none.
    const bool ends = (number.upper > 0.0 && number.upper - number.deviation < rounding) ||
      (number.lower < 0.0 && number.deviation - number.lower < rounding);
    fit.atBound = fit.atBound || (!number.mayEnd && ends);
  }
  const LearnedPrior prior(moved);
  fit.prior = prior.distribution;
  fit.information = information();
  fit.surprise = prior.surprise;
  fit.chanceOfCurve = prior.chanceOfCurve;
}

} // namespace msi

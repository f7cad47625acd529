#include "Kernels/Gap/Diagnosis/LinearFit.h"

#include <algorithm>
#include <utility>

namespace msi
{

namespace
{
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
      if (held[static_cast<std::size_t>(entry.row())] != 0 ||
        held[static_cast<std::size_t>(column)] != 0)
      {
        entry.valueRef() = entry.row() == column ? 1.0 : 0.0;
      }
    }
    right[column] = held[static_cast<std::size_t>(column)] != 0 ? 0.0 : right[column];
  }
}
}

void NormalEquationsSum::add(const std::vector<Eigen::Index>& numbers,
  const Eigen::MatrixXd& matrix, const Eigen::VectorXd& gradient)
{
  for (std::size_t column = 0; column < numbers.size(); ++column)
  {
    const auto c = static_cast<Eigen::Index>(column);
    for (std::size_t row = 0; row < numbers.size(); ++row)
    {
      Entries.emplace_back(
        numbers[row], numbers[column], matrix(static_cast<Eigen::Index>(row), c));
    }
    Gradient[numbers[column]] += gradient[c];
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
  , Off(static_cast<Eigen::Index>(Numbers.size()))
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
    const FreeNumber& number = Numbers[static_cast<std::size_t>(n)];
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
      numbers[n].variance = variance[static_cast<Eigen::Index>(n)];
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
  std::vector<char> held(static_cast<std::size_t>(matrix.rows()), 0);
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
      const FreeNumber& number = Numbers[static_cast<std::size_t>(n)];
      const double within =
        std::clamp(step[n], number.lower - number.deviation, number.upper - number.deviation);
      if (std::exchange(step[n], within) != within)
      {
        held[static_cast<std::size_t>(n)] = 1;
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
    number.deviation += step[static_cast<Eigen::Index>(n)];
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

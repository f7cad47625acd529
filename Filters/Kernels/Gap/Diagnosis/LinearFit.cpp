#include "Kernels/Gap/Diagnosis/LinearFit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <numeric>
#include <utility>

namespace msi
{

namespace
{
constexpr int Rounds = 3;         // of holding numbers at their bounds
constexpr int Learnings = 3;      // of expectation and maximization
constexpr double Rounding = 1e-9; // typical sizes

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& symmetric)
{
  return symmetric.ldlt().solve(Eigen::MatrixXd::Identity(symmetric.rows(), symmetric.cols()));
}
}

LinearFit::LinearFit(std::vector<FreeNumber> numbers, std::vector<NormalEquations> folds,
  bool besideOthers, double dispersion)
  : Numbers(std::move(numbers))
  , Folds(std::move(folds))
  , All(static_cast<Eigen::Index>(Numbers.size()))
  , Precision(All.matrix)
  , Dispersion(dispersion)
  , Off(All.gradient)
{
  for (NormalEquations& fold : Folds)
  {
    fold.matrix /= Dispersion;
    fold.gradient /= Dispersion;
    All.matrix += fold.matrix;
    All.gradient += fold.gradient;
  }
  for (Eigen::Index n = 0; n < Off.size(); ++n)
  {
    const FreeNumber& number = Numbers[static_cast<std::size_t>(n)];
    Precision(n, n) = widePrecision(number.typical);
    Off[n] = number.wanted - number.deviation;
  }
  const bool learns = besideOthers &&
    std::any_of(
      Numbers.begin(), Numbers.end(), [](const FreeNumber& number) { return number.perChannel; });
  for (int round = 0; learns && round < Learnings; ++round)
  {
    Precision = fitPrecision(withVariance());
  }
}

std::vector<FreeNumber> LinearFit::withVariance() const
{
  const Eigen::VectorXd variance = inverseOf(All.matrix + Precision).diagonal();
  std::vector<FreeNumber> numbers = Numbers;
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    numbers[n].variance = variance[static_cast<Eigen::Index>(n)];
  }
  return numbers;
}

Eigen::VectorXd LinearFit::stepWithout(std::size_t fold) const
{
  NormalEquations others = All;
  others.matrix -= Folds[fold].matrix;
  others.gradient -= Folds[fold].gradient;
  return step(std::move(others), 0.0);
}

Eigen::VectorXd LinearFit::step(NormalEquations equations, double damping) const
{
  equations.gradient += Precision * Off;
  equations.matrix += Precision;
  equations.matrix.diagonal() *= 1.0 + damping;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(Off.size());
  std::vector<Eigen::Index> free(Numbers.size());
  std::iota(free.begin(), free.end(), Eigen::Index(0));
  for (int round = 0; round < Rounds && !free.empty(); ++round)
  {
    step(free).setZero();
    const Eigen::VectorXd gradient = (equations.gradient - equations.matrix * step)(free);
    const Eigen::MatrixXd matrix = equations.matrix(free, free);
    const Eigen::VectorXd solved = matrix.ldlt().solve(gradient);
    step(free) = solved;
    const auto held = [&](Eigen::Index n)
    {
      const FreeNumber& number = Numbers[static_cast<std::size_t>(n)];
      const double within =
        std::clamp(step[n], number.lower - number.deviation, number.upper - number.deviation);
      return std::exchange(step[n], within) != within;
    };
    const auto beyond = std::remove_if(free.begin(), free.end(), held);
    if (beyond == free.end())
    {
      break;
    }
    free.erase(beyond, free.end());
  }
  return step;
}

void LinearFit::settle()
{
  All.gradient = -Precision * Off;
}

double LinearFit::penalty(const Eigen::VectorXd& step) const
{
  const Eigen::VectorXd off = step - Off;
  return Dispersion * off.dot(Precision * off);
}

Eigen::MatrixXd LinearFit::covariance(const Eigen::MatrixXd& scores) const
{
  const auto groups = static_cast<double>(scores.cols());
  const Eigen::MatrixXd half = inverseOf(All.matrix + Precision) * (scores / Dispersion);
  return groups / std::max(groups - 1.0, 1.0) * half * half.transpose();
}

void LinearFit::describe(ObservedFit& fit, const Eigen::VectorXd& step) const
{
  std::vector<FreeNumber> moved = withVariance();
  for (std::size_t n = 0; n < moved.size(); ++n)
  {
    FreeNumber& number = moved[n];
    number.deviation += step[static_cast<Eigen::Index>(n)];
    const double room = std::min(number.upper - number.deviation, number.deviation - number.lower);
    fit.atBound = fit.atBound || room < Rounding * number.typical;
  }
  const LearnedPrior prior(moved);
  fit.information = prior.informationOf(information());
  fit.surprise = prior.surprise;
  fit.chanceOfCurve = prior.chanceOfCurve;
}

} // namespace msi

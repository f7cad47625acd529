#include "Kernels/Gap/Diagnosis/LearnedPrior.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int Directions = 4;           // of a cubic
constexpr double LeastDeviation = 1e-6; // of the typical size
}

double chanceOfFraction(double fraction, int channels)
{
  if (channels <= Directions || !(fraction > 0.0))
  {
    return 1.0;
  }
  const double x = std::min(fraction, 1.0);
  const double b = 0.5 * (channels - Directions);
  return std::pow(1.0 - x, b) * (1.0 + b * x);
}

double commonFraction(const Eigen::VectorXd& deviations)
{
  const Eigen::Index channels = deviations.size();
  const double energy = deviations.squaredNorm();
  if (channels <= Directions || !(energy > 0.0))
  {
    return 0.0;
  }
  Eigen::MatrixXd basis(channels, Directions);
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(channels, -1.0, 1.0);
  basis << Eigen::VectorXd::Ones(channels), x.matrix(), x.square().matrix(), x.cube().matrix();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(channels, Directions);
  return std::min((q.transpose() * deviations).squaredNorm() / energy, 1.0);
}

double chanceOfCubic(const Eigen::VectorXd& deviations)
{
  return chanceOfFraction(commonFraction(deviations), static_cast<int>(deviations.size()));
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
  Eigen::Index first, size;
  FreeNumber kind;          // of the first number
  Eigen::ArrayXd deviation; // from neutral; with a mean of their own from that
  double learned = 0.0;     // variance of numbers of single channels
  double mean = 0.0;        // from neutral, of those with a mean of their own

  // Of numbers of single channels, whose mean has this variance where it is their own.
  Eigen::MatrixXd covariance(double ofMean) const
  {
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(size, size, kind.ownMean ? ofMean : 0.0);
    covariance.diagonal().array() += learned;
    return covariance;
  }
};

double widestVariance(double typical)
{
  return squareOf(Decision::FreeSpread * typical);
}

std::vector<Group> groupsOf(const std::vector<FreeNumber>& numbers)
{
  std::vector<Group> groups;
  const auto count = static_cast<Eigen::Index>(numbers.size());
  const auto at = [&numbers](Eigen::Index n) -> const FreeNumber&
  { return numbers[static_cast<std::size_t>(n)]; };
  for (Eigen::Index first = 0; first < count; first += groups.back().size)
  {
    Group group{ first, 1, at(first), {} };
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
    const double widest = widestVariance(group.kind.typical);
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

double widePrecision(double typical) noexcept
{
  return std::pow(Decision::FreeSpread * typical, -2);
}

Eigen::MatrixXd fitPrecision(const std::vector<FreeNumber>& numbers)
{
  const auto count = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(count, count);
  for (const Group& group : groupsOf(numbers))
  {
    auto block = precision.block(group.first, group.first, group.size, group.size);
    if (group.kind.perChannel)
    {
      block = group.covariance(widestVariance(group.kind.typical))
                .llt()
                .solve(Eigen::MatrixXd::Identity(group.size, group.size));
    }
    else
    {
      block.diagonal().setConstant(widePrecision(group.kind.typical));
    }
  }
  return precision;
}

LearnedPrior::LearnedPrior(const std::vector<FreeNumber>& numbers)
{
  const auto count = static_cast<Eigen::Index>(numbers.size());
  covariance = Eigen::MatrixXd::Zero(count, count);
  for (const Group& group : groupsOf(numbers))
  {
    auto block = covariance.block(group.first, group.first, group.size, group.size);
    const double square = squareOf(group.kind.typical);
    const auto cauchy = [&](double value) { return std::log1p(value * value / square); };
    if (group.kind.perChannel)
    {
      block = group.covariance(square);
      surprise += 0.5 * group.deviation.square().sum() / group.learned + cauchy(group.mean);
      if (!group.kind.mayFollowCurve)
      {
        chanceOfCurve = std::fmin(chanceOfCurve, chanceOfCubic(group.deviation.matrix()));
      }
    }
    else
    {
      block.diagonal().setConstant(square);
      surprise += group.kind.normal ? 0.5 * group.deviation.square().sum() / square
                                    : group.deviation.unaryExpr(cauchy).sum();
    }
  }
}

Eigen::VectorXd LearnedPrior::informationOf(const Eigen::MatrixXd& information) const
{
  if (covariance.size() == 0)
  {
    return {};
  }
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
    root.transpose() * information * root, Eigen::EigenvaluesOnly)
    .eigenvalues()
    .cwiseMax(0.0);
}

} // namespace msi

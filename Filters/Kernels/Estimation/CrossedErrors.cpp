#include "Kernels/Estimation/CrossedErrors.h"

#include "Kernels/Numerics/StudentQuantile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr double NotKnown = std::numeric_limits<double>::quiet_NaN();

double meanOfKnown(const Eigen::Ref<const Eigen::MatrixXd>& values)
{
  const auto known = !values.array().isNaN();
  return known.select(values.array(), 0.0).sum() / static_cast<double>(known.count());
}

// Half the width of the interval of the mean of residuals that are 0 on average.
double halfWidth(const Eigen::MatrixXd& residuals)
{
  const auto known = !residuals.array().isNaN();
  const Eigen::MatrixXd values = known.select(residuals.array(), 0.0);
  const double count = static_cast<double>(known.count());
  const Eigen::Index draws = values.rows();
  const auto samples = known.colwise().any().count();
  const auto degrees = std::min<Eigen::Index>(draws, samples) - 1;
  if (degrees < 1)
  {
    return NotKnown;
  }
  const auto inflation = [](Eigen::Index clusters)
  { return static_cast<double>(clusters) / static_cast<double>(clusters - 1); };
  const double single = values.squaredNorm();
  const double variance = inflation(draws) * values.rowwise().sum().squaredNorm() +
    inflation(samples) * values.colwise().sum().squaredNorm() - single;
  return studentQuantile(0.95, static_cast<int>(degrees)) * std::sqrt(std::max(variance, single)) /
    count;
}

ErrorInterval intervalOfLogarithm(double value, double halfWidth)
{
  return { value, value * std::exp(-halfWidth), value * std::exp(halfWidth) };
}
}

ErrorInterval meanError(const Eigen::Ref<const Eigen::MatrixXd>& errors)
{
  const double mean = meanOfKnown(errors);
  if (mean == 0.0)
  {
    return {};
  }
  return intervalOfLogarithm(mean, halfWidth(errors.array() / mean - 1.0));
}

PairedErrors compareErrors(
  const Eigen::Ref<const Eigen::MatrixXd>& first, const Eigen::Ref<const Eigen::MatrixXd>& second)
{
  if (first.rows() != second.rows() || first.cols() != second.cols())
  {
    throw std::invalid_argument("errors of two methods are on other draws or samples; expected the "
                                "same for both");
  }
  const double meanOfFirst = meanOfKnown(first);
  const double meanOfSecond = meanOfKnown(second);
  const double ratio = meanOfFirst / meanOfSecond;
  PairedErrors pair;
  // To first order the logarithm of the ratio errs by the mean of this difference.
  pair.ratio = intervalOfLogarithm(
    ratio, halfWidth(first.array() / meanOfFirst - second.array() / meanOfSecond));
  const auto known = !(first.array().isNaN() || second.array().isNaN());
  const auto count = static_cast<double>(known.count());
  const auto smaller = static_cast<double>((first.array() < second.array()).count());
  const auto equal = static_cast<double>((first.array() == second.array()).count());
  pair.wins = (smaller + 0.5 * equal) / count;
  return pair;
}

} // namespace msi

#include "Kernels/Estimation/Transfer/MixtureShares.h"

#include <Eigen/QR>

#include <cmath>

namespace msi
{

Eigen::VectorXd mixtureShares(
  const std::vector<Eigen::MatrixXd>& errors, const Eigen::VectorXd& prior, double strength)
{
  const auto count = static_cast<Eigen::Index>(errors.size());
  Eigen::MatrixXd products(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    for (Eigen::Index j = 0; j < count; ++j)
    {
      products(i, j) =
        errors[static_cast<std::size_t>(i)].cwiseProduct(errors[static_cast<std::size_t>(j)]).sum();
    }
  }
  const Eigen::VectorXd pull = strength * (products * prior);
  const auto objective = [&](const Eigen::VectorXd& w)
  { return (1.0 + strength) * w.dot(products * w) - 2.0 * w.dot(pull); };

  // The optimum is the equality-constrained one of the estimators that take part in it.
  Eigen::VectorXd best = prior;
  double least = objective(prior);
  for (unsigned subset = 1; subset < (1U << static_cast<unsigned>(count)); ++subset)
  {
    std::vector<Eigen::Index> members;
    for (Eigen::Index i = 0; i < count; ++i)
    {
      if ((subset >> static_cast<unsigned>(i)) & 1U)
      {
        members.push_back(i);
      }
    }
    const auto size = static_cast<Eigen::Index>(members.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size + 1, size + 1);
    system.topLeftCorner(size, size) = (1.0 + strength) * products(members, members);
    // A multiplier in the unit of the products keeps the system balanced.
    const double unit = products.trace() > 0.0 ? products.trace() : 1.0;
    system.col(size).head(size).setConstant(unit);
    system.row(size).head(size).setConstant(unit);
    Eigen::VectorXd right(size + 1);
    right << pull(members), unit;
    const Eigen::VectorXd solved =
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(system).solve(right);
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(count);
    shares(members) = solved.head(size);
    if (shares.minCoeff() < 0.0 || !(std::abs(shares.sum() - 1.0) < 1e-9))
    {
      continue;
    }
    // The prior stays where others are better by rounding alone.
    const double value = objective(shares);
    if (value < least - 1e-12 * products.trace())
    {
      least = value;
      best = shares;
    }
  }
  return best / best.sum();
}

} // namespace msi

#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/Transfer/MixtureShares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace
{

using msi::test::randomMatrix;

Eigen::VectorXd equal(Eigen::Index count)
{
  return Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count));
}

TEST(MixtureShares, WeighsIndependentErrorsByTheirInverseVariance)
{
  const std::vector<Eigen::MatrixXd> errors{ Eigen::RowVector3d(1, 0, 0),
    Eigen::RowVector3d(0, 2, 0), Eigen::RowVector3d(0, 0, 3) };
  const Eigen::Vector3d inverse(1.0, 1.0 / 4.0, 1.0 / 9.0);
  EXPECT_TRUE(msi::mixtureShares(errors, equal(3), 0.0).isApprox(inverse / inverse.sum(), 1e-12));
}

TEST(MixtureShares, LeavesOutWhatOnlyAddsError)
{
  const std::vector<Eigen::MatrixXd> errors{ Eigen::RowVector2d(1, 1), Eigen::RowVector2d(3, 3) };
  EXPECT_TRUE(msi::mixtureShares(errors, equal(2), 0.0).isApprox(Eigen::Vector2d(1, 0), 1e-12));
}

TEST(MixtureShares, StaysAtThePriorWhereItIsStrongOrNothingTells)
{
  const Eigen::Vector3d prior(0.5, 0.3, 0.2);
  const Eigen::MatrixXd same = randomMatrix(2, 5, 1);
  EXPECT_TRUE(msi::mixtureShares({ same, same, same }, prior, 1.0).isApprox(prior, 1e-9));
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(2, 5);
  EXPECT_TRUE(msi::mixtureShares({ none, none, none }, prior, 1.0).isApprox(prior, 1e-9));
  EXPECT_TRUE(msi::mixtureShares(
    { randomMatrix(2, 5, 2), randomMatrix(2, 5, 3), randomMatrix(2, 5, 4) }, prior, 1e9)
                .isApprox(prior, 1e-6));
}

TEST(MixtureShares, IsAtLeastAsGoodAsAnyGridOfShares)
{
  const std::vector<Eigen::MatrixXd> errors{ randomMatrix(4, 6, 5), randomMatrix(4, 6, 6),
    0.7 * randomMatrix(4, 6, 5) + 0.3 * randomMatrix(4, 6, 7) };
  const Eigen::Vector3d prior(0.4, 0.4, 0.2);
  constexpr double strength = 0.6;
  const auto objective = [&](const Eigen::Vector3d& w)
  {
    const Eigen::Vector3d d = w - prior;
    return (w[0] * errors[0] + w[1] * errors[1] + w[2] * errors[2]).squaredNorm() +
      strength * (d[0] * errors[0] + d[1] * errors[1] + d[2] * errors[2]).squaredNorm();
  };
  const double found = objective(msi::mixtureShares(errors, prior, strength));
  double grid = objective(prior);
  for (double a = 0.0; a <= 1.0; a += 0.01)
  {
    for (double b = 0.0; a + b <= 1.0; b += 0.01)
    {
      grid = std::min(grid, objective({ a, b, 1.0 - a - b }));
    }
  }
  EXPECT_LE(found, grid + 1e-12);
  EXPECT_NEAR(found, grid, 1e-3 * grid);
}

}

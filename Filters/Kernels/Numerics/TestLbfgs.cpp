#include "Kernels/Numerics/Lbfgs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

TEST(Lbfgs, FindsTheMinimumOfRosenbrocksFunction)
{
  const auto rosenbrock = [](const Eigen::VectorXd& x, Eigen::VectorXd& gradient)
  {
    const double bend = x[1] - x[0] * x[0];
    gradient.resize(2);
    gradient << -2.0 * (1.0 - x[0]) - 400.0 * x[0] * bend, 200.0 * bend;
    return (1.0 - x[0]) * (1.0 - x[0]) + 100.0 * bend * bend;
  };
  msi::LbfgsOptions options;
  options.relativeDecrease = 0.0;
  options.gradientNorm = 1e-9;
  options.maximumIterations = 200;
  const auto result = msi::minimizeLbfgs(rosenbrock, Eigen::Vector2d(-1.2, 1.0), options);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.at[0], 1.0, 1e-8);
  EXPECT_NEAR(result.at[1], 1.0, 1e-8);
}

TEST(Lbfgs, StepsBackFromOutsideTheDomain)
{
  // x - log x, which is NaN or infinite at and below zero; its minimum is at 1.
  const auto barrier = [](const Eigen::VectorXd& x, Eigen::VectorXd& gradient)
  {
    gradient = Eigen::VectorXd::Constant(1, 1.0 - 1.0 / x[0]);
    return x[0] > 0.0 ? x[0] - std::log(x[0]) : std::numeric_limits<double>::quiet_NaN();
  };
  msi::LbfgsOptions options;
  options.relativeDecrease = 0.0;
  options.gradientNorm = 1e-9;
  const auto result = msi::minimizeLbfgs(barrier, Eigen::VectorXd::Constant(1, 50.0), options);
  EXPECT_NEAR(result.at[0], 1.0, 1e-8);
}

TEST(Lbfgs, StaysWhereNothingIsBetter)
{
  const auto flat = [](const Eigen::VectorXd& x, Eigen::VectorXd& gradient)
  {
    gradient = Eigen::VectorXd::Zero(x.size());
    return 3.0;
  };
  const auto result = msi::minimizeLbfgs(flat, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(result.at, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(result.iterations, 0);
  EXPECT_TRUE(result.converged);
}

TEST(Lbfgs, StaysAtAStartOutsideOfTheDomain)
{
  const auto nowhere = [](const Eigen::VectorXd&, Eigen::VectorXd& gradient)
  {
    gradient.setConstant(std::numeric_limits<double>::signaling_NaN());
    return std::numeric_limits<double>::infinity();
  };
  const auto result = msi::minimizeLbfgs(nowhere, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(result.at, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(result.iterations, 0);
  EXPECT_FALSE(result.converged);
}

}

// Minimization of a smooth function with its gradient, for the fit of hyperparameters.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace msi
{

// Returns the value and writes the gradient; an infinite or NaN value marks a point outside the
// domain, from which the line search steps back.
using DifferentiableFunction =
  std::function<double(const Eigen::VectorXd& at, Eigen::VectorXd& gradient)>;

struct LbfgsOptions
{
  int maximumIterations = 60;
  double relativeDecrease = 1e-6; // stop when a step lowers the value by less than this share of it
  double gradientNorm = 1e-4;     // stop when the largest gradient element is below
};

struct LbfgsResult
{
  Eigen::VectorXd at;
  double value = 0.0;
  int iterations = 0;
  bool converged = false; // by decrease or gradient, not by the iteration limit or a failed search
};

// Limited-memory BFGS with a backtracking and expanding line search (weak Wolfe conditions).
// Source: Liu and Nocedal, "On the limited memory BFGS method for large scale optimization", 1989, doi
//         10.1007/BF01589116; search: Lewis and Overton, "Nonsmooth optimization via quasi-Newton
//         methods", 2013, doi 10.1007/s10107-012-0514-2.
// The result is never worse than 'start'; it is 'start', not converged, where the function is not finite there.
LbfgsResult minimizeLbfgs(const DifferentiableFunction& function, const Eigen::VectorXd& start,
  const LbfgsOptions& options = {});

} // namespace msi

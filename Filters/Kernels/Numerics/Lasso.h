// Least squares with an L1 penalty.
#pragma once

#include <Eigen/Core>

namespace msi
{

// Per output n, the w_n with the least w' A w / 2 - b_n' w + penalty_n |w|_1: cyclic coordinate descent
// finds which coefficients are zero, a linear system the others.
//
// Source:   Friedman, Hastie and Tibshirani, 2010, doi 10.18637/jss.v033.i01.
// Shapes:   a is K x K, symmetric and positive semidefinite; b K x N; penalty N, not negative; the
//           result is K x N. A channel with a zero diagonal gets coefficient 0.
// Accuracy: the optimality conditions hold to 1e-9 of the largest gradient, or 4000 sweeps were made.
Eigen::MatrixXd solveLasso(
  const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& penalty);

} // namespace msi

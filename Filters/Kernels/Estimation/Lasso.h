// Least squares with an L1 penalty.
#pragma once

#include <Eigen/Core>

namespace msi
{

// Per output n, the w_n with the least w' A w / 2 - b_n' w + penalty_n |w|_1, by cyclic coordinate
// descent from zero until no coordinate changes the objective by more than 1e-14 of b_n' A^-1 b_n's
// scale (the variance it could explain), or 10000 sweeps.
//
// Source: Friedman, Hastie and Tibshirani, 2010, doi 10.18637/jss.v033.i01.
// Shapes: a is K x K, symmetric and positive semidefinite; b K x N; penalty N, not negative; the result is
//         K x N. A channel with a zero diagonal gets coefficient 0.
Eigen::MatrixXd solveLasso(
  const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& penalty);

} // namespace msi

// Least squares with no coefficient below zero.
#pragma once

#include <Eigen/Core>

namespace msi
{

struct NonNegativeSolution
{
  Eigen::VectorXd x;
  int steps = 0;         // of the active set
  bool converged = true; // false where the steps ran out; x is then the best feasible point met
};

// x >= 0 that minimises x' H x / 2 - f' x.
//
// Source: C. L. Lawson, R. J. Hanson, "Solving Least Squares Problems" (1974), ch. 23, on normal equations as in
//         R. Bro, S. de Jong, J. Chemometrics 11 (1997) 393, doi:10.1002/(SICI)1099-128X(199709/10)11:5<393::AID-CEM483>3.0.CO;2-L.
// Shapes: H n x n symmetric positive semidefinite, f n.
// Errors: std::invalid_argument for shapes that disagree.
// Cost:   a Cholesky factorisation of the positive coefficients in each step; about as many steps as
//         coefficients end up positive.
NonNegativeSolution solveNonNegative(const Eigen::MatrixXd& h, const Eigen::VectorXd& f);

} // namespace msi

// Regularised least squares in a reproducing kernel's space, with its leave-one-out errors.
#pragma once

#include <Eigen/Core>

namespace msi
{

struct KernelSolution
{
  Eigen::MatrixXd coefficients; // n x N
  Eigen::VectorXd constant;     // N
  Eigen::MatrixXd leftOutError; // n x N: measured minus the estimate of a fit without the sample
};

// f(x) = constant + sum_i c_i k(x, x_i) with the least sum_i w_i |y_i - f(x_i)|^2 + lambda |f|^2:
//   (K + lambda diag(1 / w)) c + 1 constant' = Y,   1' c = 0.
// The leave-one-out error of sample i is c_i / G_ii with G the upper left block of that system's inverse.
//
// Source:  Wahba, "Spline Models for Observational Data", 1990, doi 10.1137/1.9781611970128, chapters 1, 4.
// Shapes:  gram is n x n, symmetric and positive semidefinite; outputs n x N; weights n, positive;
//          lambda > 0. 1' c = 0 holds, so that a kernel may be changed by f(x) + f(x').
// Cost:    O(n^3 + n^2 N).
KernelSolution solveKernelSystem(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& outputs,
  const Eigen::VectorXd& weights, double lambda);

} // namespace msi

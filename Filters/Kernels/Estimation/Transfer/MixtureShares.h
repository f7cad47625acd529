// How much each of several estimators contributes to their mixture.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Shares w >= 0 of sum 1 that minimize |sum_i w_i E_i|^2 + strength |sum_i (w_i - prior_i) E_i|^2, E_i
// being the errors of estimator i on the same samples: least squared error of the mixture, drawn
// toward the prior mixture as by 'strength' times as many samples that speak for it.
//
// Shapes: all errors of one shape; prior has one share per estimator, not negative, of sum 1.
// Cost:   every subset of the estimators is solved: 2^n small systems. Meant for a few estimators.
Eigen::VectorXd mixtureShares(
  const std::vector<Eigen::MatrixXd>& errors, const Eigen::VectorXd& prior, double strength);

} // namespace msi

// What the errors of held-out samples over several draws say about another draw and other samples.
#pragma once

#include <Eigen/Core>

namespace msi
{

// Errors are draws x samples, NaN where a sample was not held out in a draw. Draws share samples, so single
// errors are not independent: variances are clustered both by draw and by sample,
//
//   var = (D/(D-1) sum_d R_d^2 + S/(S-1) sum_s C_s^2 - sum r^2) / n^2, at least sum r^2 / n^2,
//
// with R_d and C_s the sums of residuals r of a draw and of a sample, and n the number of errors; intervals
// are by Student's t with min(D, S) - 1 degrees of freedom. They are about other draws of tuning samples and other
// samples of the medium.
//
// Source: A. C. Cameron, J. B. Gelbach and D. L. Miller, "Robust inference with multiway clustering", 2011, doi
//         10.1198/jbes.2010.07136.
// NaN:    with fewer than 2 draws or 2 samples there is an estimate and no interval; without errors neither.
struct ErrorInterval
{
  double value = 0.0;
  double low = 0.0; // 95 %
  double high = 0.0;
};

// The mean of errors that are not negative. The interval is that of its logarithm, so it is positive.
ErrorInterval meanError(const Eigen::Ref<const Eigen::MatrixXd>& errors);

struct PairedErrors
{
  ErrorInterval ratio; // of the means: below 1 where the first is better
  double wins = 0.0;   // share of the errors where the first is smaller; equal ones count half

  // -1 where the first is better, 1 where the second is, 0 where the interval holds 1 or there is none.
  int sign() const noexcept { return ratio.high < 1.0 ? -1 : ratio.low > 1.0 ? 1 : 0; }
};

// Both on the same draws and samples.
// Errors: std::invalid_argument where shapes differ.
PairedErrors compareErrors(
  const Eigen::Ref<const Eigen::MatrixXd>& first, const Eigen::Ref<const Eigen::MatrixXd>& second);

} // namespace msi

// The R-model: a tridiagonal correction of estimated reflectance, fitted on tuning samples.
#pragma once

#include "Kernels/Numerics/AffineTransform.h"
#include "Kernels/Numerics/FitSummary.h"

#include <Eigen/Core>

namespace msi
{

struct RModelFit
{
  AffineTransform correction; // N x (N+1): estimated reflectance -> corrected reflectance
  FitSummary summary;
};

// Per band, least squares of s(i) = a1 r(i-1) + a2 r(i) + a3 r(i+1) + a4 over the tuning samples; the
// first and last band have one neighbour. The whole method is
//   AffineTransform::compose(fitRModel(W(V), S).correction, W).
//
// Source:  "Correcting cross-media instrument metamerism for reflectance estimation in multispectral
//          imaging", 2011, doi 10.1364/JOSAA.28.000511, Eq. 1.
// Shapes:  estimated and measured reflectance of the same tuning samples, both N x L.
// Errors:  std::invalid_argument where the shapes differ, a value is not finite, or L < 4 (a row has
//          four unknowns; three where N = 2, two where N = 1).
//          A row whose system is singular takes, among its least-squares solutions, the one nearest to "leave
//          the band as it is"; the summary is then not complete and names how many rows.
// Summary: residualRms over N x L; the weakest rank and worst condition among the rows.
// Cost:    O(N L).
RModelFit fitRModel(const Eigen::MatrixXd& estimated, const Eigen::MatrixXd& measured);

} // namespace msi

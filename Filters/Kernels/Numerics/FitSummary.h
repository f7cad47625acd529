// What a fit has to say about itself.
#pragma once

#include <Eigen/Core>

#include <string>

namespace msi
{

// residualRms: root mean square of the fitted quantity over the samples that were fitted.
// rank:        numerical rank of the least-squares system (of the weakest one where there are many).
// condition:   ratio of the largest to the smallest singular value that counts toward the rank
//              (of the worst system where there are many).
// unknowns:    free coefficients of the whole fit.
// samples:     samples that took part.
// iterations:  rounds of an alternating fit, or steps of an optimizer; 1 for a closed form.
// complete:    false where something was undetermined or a fallback was taken; 'status' says what.
// status:      one sentence for the user; never empty after a fit.
struct FitSummary
{
  double residualRms = 0.0;
  Eigen::Index rank = 0;
  double condition = 0.0;
  Eigen::Index unknowns = 0;
  Eigen::Index samples = 0;
  int iterations = 0;
  bool complete = true;
  std::string status;
};

} // namespace msi

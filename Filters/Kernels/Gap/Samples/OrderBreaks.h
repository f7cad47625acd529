// Where in the capture order the gap breaks.
#pragma once

#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/EffectFit.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Cumulative sums of a residual along the capture time: for every place between two samples the weighted
// least-squares step behind it, as a gain of the response or an offset, common or per channel.
// Empty where the scene has no order.
class OrderBreaks
{
public:
  OrderBreaks(const EffectFitter& fitter, const Eigen::MatrixXd& predicted);

  // Starting points {change, place, width} for a form with a step, the best places first.
  std::vector<std::vector<double>> startsFor(const EffectForm& form) const;

  // Breaks of the common gain that stand out by five standard errors or more beside a straight line, at most `most`,
  // found one after the other by binary segmentation: a drift has none.
  static std::vector<GapChangePoint> significant(
    const EffectFitter& fitter, const Eigen::MatrixXd& predicted, int most);

private:
  struct Break
  {
    double place, change, gain;
  };
  static void keepBest(std::vector<Break>& list, const Break& candidate);

  std::vector<Break> Gain, GainPerChannel, Offset;
  double Width = 0.02;
};

} // namespace msi

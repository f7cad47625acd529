// From responses to the features on which the method "transfer" compares samples.
#pragma once

#include "Kernels/Estimation/Transfer/TransferSpace.h"

#include <Eigen/Core>

namespace msi
{

// Responses of the target are first brought to those of the chart: z = exp(gain) v + offset, channel
// by channel; then to the expert's space, centered and scaled with the chart's statistics.
struct TransferFeatures
{
  TransferSpace space = TransferSpace::Linear;
  double responseScale = 1.0; // responses are divided by it first
  Eigen::VectorXd center;     // K
  double scale = 1.0;
  Eigen::VectorXd logGain; // K
  Eigen::VectorXd offset;  // K

  Eigen::MatrixXd ofChart(const Eigen::MatrixXd& responses) const;
  Eigen::MatrixXd ofTarget(const Eigen::MatrixXd& responses) const;
};

// Feature statistics of the chart, without gain and offset.
TransferFeatures featuresOf(TransferSpace space, const Eigen::MatrixXd& chartResponses);

} // namespace msi

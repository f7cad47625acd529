// How far a simulated camera lies from the real one, channel by channel.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Of one channel, over the samples with a finite value on both sides. All in units of the responses; NaN without
// such samples.
struct ChannelDifference
{
  Eigen::Index samples = 0;
  double mean = 0.0; // real - simulated
  double rms = 0.0;
  // The line real = gain simulated + offset by least squares, and the rms of what it leaves. Gain NaN where all
  // simulated values are the same.
  double gain = 0.0;
  double offset = 0.0;
  double rmsAroundLine = 0.0;
};

// Shapes: K x S each. Errors: std::invalid_argument naming both shapes where they differ.
std::vector<ChannelDifference> responseDifference(
  const Eigen::MatrixXd& real, const Eigen::MatrixXd& simulated);

} // namespace msi

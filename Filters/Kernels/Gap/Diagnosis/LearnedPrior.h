// What the free numbers of a set of effects look like before the data speak; the scatter over channels is learned.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

struct FreeNumber
{
  std::size_t group = 0; // numbers of one group stand together and differ in the channel only
  bool perChannel = false;
  bool ownMean =
    false; // of numbers of channels: the effect also has a form with one number for all of them
  double deviation = 0.0; // from neutral
  double spread = 1.0;    // standard deviation before the data speak
  double scale = 1.0;     // typical size
};

struct LearnedPrior
{
  // The variance of numbers of single channels is learned from them, and their mean where `ownMean`.
  explicit LearnedPrior(const std::vector<FreeNumber>& numbers);

  // Prior variance over noise variance along its principal axes. information: normal matrix of the numbers without any
  // prior.
  Eigen::VectorXd informationOf(const Eigen::MatrixXd& information) const;

  Eigen::MatrixXd covariance;
  // Half the sum of squares of numbers of channels over their learned deviations.
  double surprise = 0.0;
  // Probability that independent numbers of channels follow a smooth curve over the channels as closely; the smallest of
  // all groups.
  double chanceOfCurve = 1.0;
};

} // namespace msi

// What the free numbers of a set of effects look like before the data speak; the scatter over channels is learned.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

// Probability that `directions` fixed directions hold the part `fraction` or more of the energy of independent normal
// deviations of `channels` channels: the upper tail of the Beta distribution (directions / 2, (channels - directions) / 2).
// 1 where there are not more channels than directions.
double chanceOfFraction(double fraction, int directions, int channels);

// The part of the deviations' energy in a cubic over the channels: what a smooth change of the light does to them.
double commonFraction(const Eigen::VectorXd& deviations);

// Probability that independent normal deviations have that part there, or more.
double chanceOfCubic(const Eigen::VectorXd& deviations);

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

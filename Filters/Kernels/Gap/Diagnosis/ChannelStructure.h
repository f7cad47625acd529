// Whether numbers of single channels look like independent errors.
#pragma once

#include <Eigen/Core>

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

} // namespace msi

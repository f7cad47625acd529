// Areas of an image that are even and shaped like parallelograms: what patches of a chart look like.
#pragma once

#include "Kernels/Sampling/ChartImage.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

struct EvenRegion
{
  Eigen::Vector2d center; // pixels of the image
  double area = 0.0;      // pixels
};

// Connected areas (4 neighbours) where no channel changes by more than a threshold, for a ladder of thresholds; of
// areas at one place the largest is kept.
//
// Shape: an area A with covariance C of its pixels is a parallelogram where A² = 144 det C; it is 9.7 % larger for an
//        ellipse and smaller for areas with holes or spurs. Areas within -10 % and +5 %, not more than 4 times as long as
//        wide, of at least 16 pixels and away from the image's border are kept.
// Cost:  a few passes over the image per threshold.
std::vector<EvenRegion> findEvenRegions(const ChartImage& image);

} // namespace msi

// Whether the pixels of a patch can be trusted: clipped, or not even.
#pragma once

#include <Eigen/Core>

namespace msi
{

struct PatchQuality
{
  double clipped = 0.0; // 0..1: pixels that reach the clipping level in any channel
  double outliers =
    0.0; // 0..1: pixels far from the patch's median, such as dust, scratches and highlights
  double slope =
    0.0; // largest difference between the halves of the patch, relative to its mean: shadows
};

// pixels: channels x pixels of one patch; places: 2 x pixels. clipping: per channel, infinity where unknown.
//
// An outlier lies more than 5 robust standard deviations (1.4826 times the median absolute deviation) and more than 2 %
// of the patch's level from its median, in the mean over the channels. Of normal noise one pixel in two million does.
// NaN: pixels that are not finite count as clipped.
PatchQuality patchQuality(const Eigen::Ref<const Eigen::MatrixXf>& pixels,
  const Eigen::Ref<const Eigen::Matrix2Xd>& places,
  const Eigen::Ref<const Eigen::VectorXf>& clipping);

} // namespace msi

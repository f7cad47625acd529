// Three sums over the values of a pixel, in single precision: reflectance or responses to XYZ.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace msi
{

// xyz = weights x + constant.
//
// Shape:    weights 3 x values; x values x pixels and xyz 3 x pixels, contiguous, pixel after pixel.
// Accuracy: four sums over every fourth value, in groups of 32 values, then the sums of these. The error is at most
//           12 eps (|weights| |x| + |constant|) with eps = 2^-24 up to 32 values, and grows by one eps for 32 more.
// Bytes:    a pixel's XYZ depends on the pixel alone, not on its place, the thread or the instruction set. A NaN or an
//           infinity stays in its own pixel.
class TristimulusBlocks
{
public:
  TristimulusBlocks() = default;
  explicit TristimulusBlocks(
    const Eigen::Matrix3Xd& weights, const Eigen::Vector3d& constant = Eigen::Vector3d::Zero());

  Eigen::Index values() const noexcept { return Values; }

  void apply(const float* values, float* xyz, Eigen::Index pixels) const noexcept;
  // The same XYZ in three planes: X of all pixels, from planeStride on their Y, then Z.
  void applyToPlanes(
    const float* values, float* xyz, Eigen::Index planeStride, Eigen::Index pixels) const noexcept;

private:
  Eigen::Index Values = 0;
  // Per four values: those of X, those of Y, those of Z, zeros. The last four overlap the ones before, with zeros for
  // what they have summed.
  std::vector<float> Weights;
  std::array<float, 16> Constant{}; // in the same order, each four times
};

} // namespace msi

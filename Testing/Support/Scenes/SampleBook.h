// A picture: swatches of dyed fabric on a tartan, under a lamp from one side.
#pragma once

#include "PatchLayout.h"

#include <Eigen/Core>

#include <cstdint>

namespace msi::scenes
{

// What the camera looks at: for every pixel the swatch (0 = tartan, 1.. = swatch) and its light.
class SampleBook
{
public:
  static constexpr PatchLayout Layout{ 6, 4, 6, 13, 42, 34, 38, 256, 192 };

  // bodies: swatch reflectances on the scene grid; yarns: those of the tartan.
  SampleBook(Eigen::MatrixXd bodies, Eigen::MatrixXd yarns, std::uint64_t seed);

  // Reflectance factor towards the camera, relative to a perfect white in even light.
  Eigen::ArrayXd seen(int x, int y) const;

  // Pixels that belong to a swatch with certainty: two pixels inside its edge.
  static LabelImage labels() { return Layout.labels(2); }

  // Light on the scene relative to the middle of the field: lamp to the left, vignetting lens.
  static double light(int x, int y) noexcept;

private:
  Eigen::MatrixXd Bodies;
  Eigen::MatrixXd Yarns;
  std::uint64_t Seed;
};

} // namespace msi::scenes

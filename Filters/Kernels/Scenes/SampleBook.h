// A picture: swatches of dyed fabric on a tartan.
#pragma once

#include "Kernels/Scenes/PatchLayout.h"
#include "Kernels/Scenes/WovenFabric.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace msi::scenes
{

// Factors on the weaves of a picture.
struct WeaveChange
{
  double yarnWidth = 1.0;
  double texture = 1.0; // relief and scatter; 0: a plane of even shade
  double cavity = 1.0;  // probability that reflected light strikes again
};

// What the camera looks at: for every pixel the swatch (0 = tartan, 1.. = swatch).
class SampleBook
{
public:
  // bodies: swatch reflectances; yarns: those of the tartan (tartanYarns()), on the same wavelengths.
  SampleBook(const PatchLayout& layout, Eigen::MatrixXd bodies, Eigen::MatrixXd yarns,
    std::uint64_t seed, const WeaveChange& change = {});

  const PatchLayout& layout() const noexcept { return Layout; }

  // Reflectance factor towards the camera, relative to a perfect white in even light.
  Eigen::ArrayXd seen(int x, int y) const;
  // Its mean over a swatch, 1...
  Eigen::ArrayXd meanSeen(int patch) const;

private:
  PatchLayout Layout;
  Eigen::MatrixXd Bodies;
  Eigen::MatrixXd Yarns;
  std::uint64_t Seed;
  std::vector<Weave> Weaves; // of the swatches
  Weave Tartan;
};

} // namespace msi::scenes

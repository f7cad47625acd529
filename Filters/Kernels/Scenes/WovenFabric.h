// The surface of a woven fabric as a 45/0 camera sees it.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace msi::scenes
{

// Reflectance of a fibre's surface, which adds to that of its body.
inline constexpr double FibreSurface = 0.012;

// A weave of crossing yarns, sampled in pixels. Each pixel of a yarn's round back receives its own share
// of the light (Shade), and a share of what it reflects strikes a yarn again (Cavity).
struct Weave
{
  double yarnWidth = 4.3;       // pixels
  int twill = 1;                // 1 plain weave; 2 a 2/1 twill
  double meanShade = 0.90;      // of the light that a flat sample would get
  double shadeDepth = 0.30;     // from the back of a yarn to the gap
  double meanCavity = 0.16;     // probability that reflected light strikes again
  double cavityDepth = 1.2;     // relative, from the back of a yarn to the gap
  double yarnVariation = 0.025; // standard deviation of the shade from yarn to yarn
  double fibreVariation = 0.02; // from pixel to pixel
};

// One point of the surface.
struct WeavePoint
{
  double shade;
  double cavity;
  bool warp; // this yarn runs along y
  int yarn;  // number of the yarn in its direction
};

WeavePoint weavePoint(const Weave& weave, int x, int y, std::uint64_t seed) noexcept;

// What the camera sees of a body reflectance r there: Shade r (1 - Cavity) / (1 - Cavity r).
inline Eigen::ArrayXd seenThrough(const WeavePoint& point, const Eigen::ArrayXd& body)
{
  return point.shade * (1.0 - point.cavity) * body / (1.0 - point.cavity * body);
}

// Its mean over the weave, without the scatter from yarn to yarn and pixel to pixel: the midpoint rule over the back of a
// yarn and its arch.
Eigen::ArrayXd meanSeenThrough(const Weave& weave, const Eigen::ArrayXd& body);

} // namespace msi::scenes

#include "WovenFabric.h"

#include "Kernels/Camera/CounterRandom.h"

#include <algorithm>
#include <cmath>

namespace msi::scenes
{

namespace
{
enum Stream : std::uint32_t
{
  WarpYarn = 11,
  WeftYarn,
  Fibre
};

int positiveModulo(int value, int modulus)
{
  return ((value % modulus) + modulus) % modulus;
}
}

WeavePoint weavePoint(const Weave& weave, int x, int y, std::uint64_t seed) noexcept
{
  const double u = x / weave.yarnWidth;
  const double v = y / weave.yarnWidth;
  const int warpYarn = static_cast<int>(std::floor(u));
  const int weftYarn = static_cast<int>(std::floor(v));
  WeavePoint point{};
  point.warp = positiveModulo(warpYarn + weftYarn, weave.twill + 1) != 0;
  point.yarn = point.warp ? warpYarn : weftYarn;

  // Across the yarn its round back, along it the arch from one crossing to the next.
  const double across = 2.0 * (point.warp ? u - warpYarn : v - weftYarn) - 1.0;
  const double along = 2.0 * (point.warp ? v - weftYarn : u - warpYarn) - 1.0;
  const double height = 0.7 * (1.0 - across * across) + 0.3 * (1.0 - along * along);
  constexpr double MeanHeight = 2.0 / 3.0;

  const CounterRandom yarn(seed, point.warp ? WarpYarn : WeftYarn);
  const CounterRandom fibre(seed, Fibre);
  const auto pixel = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32) |
    static_cast<std::uint32_t>(x);
  const double variation =
    weave.yarnVariation * yarn.normal(static_cast<std::uint32_t>(point.yarn)) +
    weave.fibreVariation * fibre.normal(pixel);
  point.shade = std::max(
    0.05, weave.meanShade + weave.shadeDepth * (height - MeanHeight) + weave.meanShade * variation);
  point.cavity = std::clamp(weave.meanCavity * (1.0 + 1.2 * (MeanHeight - height)), 0.0, 0.9);
  return point;
}

} // namespace msi::scenes

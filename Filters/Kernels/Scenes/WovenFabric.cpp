#include "Kernels/Scenes/WovenFabric.h"

#include "Kernels/Numerics/CounterRandom.h"

#include <algorithm>
#include <cmath>

namespace msi::scenes
{

namespace
{
enum : std::uint32_t
{
  WarpYarn = 11,
  WeftYarn,
  Fibre
};

constexpr double MeanHeight = 2.0 / 3.0;

// Across a yarn its round back, along it the arch from one crossing to the next; both from -1 to 1.
double heightAt(double across, double along)
{
  return 0.7 * (1.0 - across * across) + 0.3 * (1.0 - along * along);
}

double cavityAt(const Weave& weave, double height)
{
  return std::clamp(weave.meanCavity * (1.0 + weave.cavityDepth * (MeanHeight - height)), 0.0, 0.9);
}

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

  const double across = 2.0 * (point.warp ? u - warpYarn : v - weftYarn) - 1.0;
  const double along = 2.0 * (point.warp ? v - weftYarn : u - warpYarn) - 1.0;
  const double height = heightAt(across, along);

  const CounterRandom yarn(seed, point.warp ? WarpYarn : WeftYarn);
  const CounterRandom fibre(seed, Fibre);
  const auto pixel = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32) |
    static_cast<std::uint32_t>(x);
  const double variation =
    weave.yarnVariation * yarn.normal(static_cast<std::uint32_t>(point.yarn)) +
    weave.fibreVariation * fibre.normal(pixel);
  point.shade = std::max(
    0.05, weave.meanShade + weave.shadeDepth * (height - MeanHeight) + weave.meanShade * variation);
  point.cavity = cavityAt(weave, height);
  return point;
}

Eigen::ArrayXd meanSeenThrough(const Weave& weave, const Eigen::ArrayXd& body)
{
  constexpr int Steps = 64;
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(body.size());
  for (int i = 0; i < Steps; ++i)
  {
    for (int j = 0; j < Steps; ++j)
    {
      const double height = heightAt((i + 0.5) / Steps, (j + 0.5) / Steps);
      WeavePoint point{};
      point.shade = weave.meanShade + weave.shadeDepth * (height - MeanHeight);
      point.cavity = cavityAt(weave, height);
      sum += seenThrough(point, body);
    }
  }
  return sum / (Steps * Steps);
}

} // namespace msi::scenes

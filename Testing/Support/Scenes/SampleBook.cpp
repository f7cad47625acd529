#include "SampleBook.h"

#include "Measuring.h"
#include "WovenFabric.h"

#include <array>
#include <utility>

namespace msi::scenes
{

namespace
{
constexpr int ShadowWidth = 2;
constexpr double ShadowDepth = 0.55;
constexpr double FibreSurface = 0.012;

// Which yarn of the tartan lies at a position: a symmetric sett of four colours.
constexpr std::array<int, 24> Sett = { 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 2, 2, 2, 2, 3, 2, 2, 2, 2, 0,
  0, 1, 1, 0 };

Weave tartanWeave()
{
  Weave weave;
  weave.twill = 2;
  weave.yarnWidth = 3.1;
  weave.meanShade = 0.82;
  return weave;
}
}

SampleBook::SampleBook(Eigen::MatrixXd bodies, Eigen::MatrixXd yarns, std::uint64_t seed)
  : Bodies(std::move(bodies))
  , Yarns(std::move(yarns))
  , Seed(seed)
{
}

Eigen::ArrayXd SampleBook::seen(int x, int y) const
{
  const PatchLayout::Place place = Layout.placeOf(x, y);
  if (place.patch > 0)
  {
    const Weave weave = weaveOf(place.patch - 1, Seed);
    const WeavePoint point =
      weavePoint(weave, place.x, place.y, Seed + 1000U * static_cast<std::uint64_t>(place.patch));
    return FibreSurface + seenThrough(point, Bodies.col(place.patch - 1).array());
  }
  WeavePoint point = weavePoint(tartanWeave(), x, y, Seed);
  // A swatch casts its shadow to the right and downwards.
  if (Layout.placeOf(x - ShadowWidth, y - ShadowWidth).patch > 0)
  {
    point.shade *= ShadowDepth;
  }
  const int yarn = Sett[static_cast<std::size_t>(point.yarn) % Sett.size()];
  return FibreSurface + seenThrough(point, Yarns.col(yarn).array());
}

double SampleBook::light(int x, int y) noexcept
{
  const double u = (x - 0.5 * Layout.width) / (0.5 * Layout.width);
  const double v = (y - 0.5 * Layout.height) / (0.5 * Layout.width);
  return (1.0 - 0.07 * u + 0.02 * v) * (1.0 - 0.06 * (u * u + v * v));
}

} // namespace msi::scenes

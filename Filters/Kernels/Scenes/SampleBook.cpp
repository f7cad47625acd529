#include "Kernels/Scenes/SampleBook.h"

#include "Kernels/Scenes/Measuring.h"
#include "Kernels/Scenes/WovenFabric.h"

#include <array>
#include <utility>

namespace msi::scenes
{

namespace
{
constexpr int ShadowWidth = 2;
constexpr double ShadowDepth = 0.55;

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

Weave changed(Weave weave, const WeaveChange& change)
{
  weave.yarnWidth *= change.yarnWidth;
  weave.shadeDepth *= change.texture;
  weave.cavityDepth *= change.texture;
  weave.yarnVariation *= change.texture;
  weave.fibreVariation *= change.texture;
  weave.meanCavity *= change.cavity;
  return weave;
}
}

SampleBook::SampleBook(const PatchLayout& layout, Eigen::MatrixXd bodies, Eigen::MatrixXd yarns,
  std::uint64_t seed, const WeaveChange& change)
  : Layout(layout)
  , Bodies(std::move(bodies))
  , Yarns(std::move(yarns))
  , Seed(seed)
  , Tartan(changed(tartanWeave(), change))
{
  for (int patch = 0; patch < layout.count(); ++patch)
  {
    Weaves.push_back(changed(weaveOf(patch, seed), change));
  }
}

Eigen::ArrayXd SampleBook::seen(int x, int y) const
{
  const PatchLayout::Place place = Layout.placeOf(x, y);
  if (place.patch > 0)
  {
    const WeavePoint point = weavePoint(Weaves[static_cast<std::size_t>(place.patch - 1)], place.x,
      place.y, Seed + 1000U * static_cast<std::uint64_t>(place.patch));
    return FibreSurface + seenThrough(point, Bodies.col(place.patch - 1).array());
  }
  WeavePoint point = weavePoint(Tartan, x, y, Seed);
  // A swatch casts its shadow to the right and downwards.
  if (Layout.placeOf(x - ShadowWidth, y - ShadowWidth).patch > 0)
  {
    point.shade *= ShadowDepth;
  }
  const int yarn = Sett[static_cast<std::size_t>(point.yarn) % Sett.size()];
  return FibreSurface + seenThrough(point, Yarns.col(yarn).array());
}

Eigen::ArrayXd SampleBook::meanSeen(int patch) const
{
  const auto swatch = static_cast<std::size_t>(patch - 1);
  return FibreSurface + meanSeenThrough(Weaves[swatch], Bodies.col(patch - 1).array());
}

} // namespace msi::scenes

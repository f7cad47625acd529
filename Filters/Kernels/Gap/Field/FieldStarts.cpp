#include "Kernels/Gap/Field/FieldStarts.h"

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/Imaging/ChannelDisplacement.h"
#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
constexpr double LeastMove = 0.5; // pixels: a fit by gradients finds less by itself

// A channel of the simulated image, and of the real one.
std::vector<PixelBuffer> tilesOf(const FieldPair& pair, std::size_t channel)
{
  const std::size_t K = pair.channels.size();
  std::vector<PixelBuffer> tiles;
  for (const ImageWindow& window : displacementTiles(pair.extent))
  {
    PixelBuffer& tile = tiles.emplace_back();
    tile.resize(window, 2);
    for (int y = window.y; y < window.y + window.height; ++y)
    {
      for (int x = window.x; x < window.x + window.width; ++x)
      {
        const std::size_t value = pair.index(x, y) * K + channel;
        tile.pixel(x, y)[0] = pair.simulated[value];
        tile.pixel(x, y)[1] = pair.real[value];
      }
    }
  }
  return tiles;
}
}

std::vector<ImageDisplacement> registrationStart(const FieldPair& pair, const FieldLoop& loop)
{
  const ImageExtent& extent = pair.extent;
  const auto K = static_cast<int>(pair.channels.size());
  if (std::min(extent.width, extent.height) < DisplacementSearch::LeastTileSide)
  {
    return {};
  }
  std::vector<ImageDisplacement> start(static_cast<std::size_t>(K));
  const double corner = 0.5 * std::hypot(extent.width, extent.height);
  loop(K,
    [&](int channel)
    {
      const std::vector<PixelBuffer> tiles = tilesOf(pair, static_cast<std::size_t>(channel));
      const ChannelDisplacement found =
        DisplacementSearch(tiles, extent, DisplacementModel::Similarity)(0, 1);
      const double farthest = std::hypot(found.right, found.down) +
        corner * std::hypot(found.magnification, Degree * found.rotation);
      if (found.standardError.isFinite().all() && farthest > LeastMove)
      {
        start[static_cast<std::size_t>(channel)] = { found.right, found.down, found.magnification,
          found.rotation };
      }
    });
  const bool far = std::any_of(start.begin(), start.end(),
    [](const ImageDisplacement& one) { return one.right != 0.0 || one.down != 0.0; });
  return far ? start : std::vector<ImageDisplacement>();
}

namespace
{
constexpr double LeastLevel = 0.1;
constexpr std::size_t FewestPixels = 20; // beyond the level
constexpr double Better = 0.5;           // of the squares beyond the level must go
}

const std::vector<ImageTerm>& clippingTerms()
{
  return effectWith(EffectTrait::LimitsResponse).imageForms.front().terms;
}

namespace
{
struct ClipPixel
{
  double level; // of the model
  double real;
};

double findClipLevel(std::vector<ClipPixel> pixels)
{
  std::sort(pixels.begin(), pixels.end(),
    [](const ClipPixel& a, const ClipPixel& b)
    { return a.level != b.level ? a.level > b.level : a.real > b.real; });
  // From the brightest down: the mean of the real values beyond a level is the level.
  double n = 0.0;
  double sum = 0.0;
  double square = 0.0;
  double before = 0.0;
  double most = 0.0;
  double best = numberOf(clippingTerms()[1].parameter).neutral;
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const auto& [level, real] = pixels[i];
    n += 1.0;
    sum += real;
    square += real * real;
    before += (real - level) * (real - level);
    const double mean = sum / n;
    const double gain = before - (square - sum * mean);
    // Where the brightest are seen darker than the level that they pass the level is theirs.
    if (i + 1 >= FewestPixels && level >= LeastLevel && mean <= level && gain > most &&
      gain > Better * before)
    {
      most = gain;
      best = mean;
    }
  }
  return best;
}
}

Eigen::ArrayXd findClipLevels(const std::vector<FieldResidual>& residuals, Eigen::Index channels)
{
  std::vector<std::vector<ClipPixel>> own(static_cast<std::size_t>(channels));
  std::vector<ClipPixel> all;
  for (std::size_t part = 0; part < residuals.size(); ++part)
  {
    const FieldResidual& here = residuals[part];
    for (Eigen::Index n = 0; n < here.level.size(); ++n)
    {
      all.push_back({ here.level[n], here.level[n] + here.residual[n] });
      own[part % own.size()].push_back(all.back());
    }
  }
  const double neutral = numberOf(clippingTerms()[1].parameter).neutral;
  const double common = findClipLevel(std::move(all));
  Eigen::ArrayXd levels(channels);
  std::transform(std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()),
    levels.begin(), findClipLevel);
  const double found = (levels == neutral).select(0.0, levels).maxCoeff();
  const double other = common != neutral || found == 0.0 ? common : found;
  return (levels == neutral).select(other, levels);
}

} // namespace msi

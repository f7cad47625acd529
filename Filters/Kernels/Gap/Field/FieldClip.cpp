#include "Kernels/Gap/Field/FieldClip.h"

#include "Kernels/Gap/Field/FieldColumns.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
constexpr double LeastLevel = 0.1;
constexpr std::size_t FewestPixels = 20; // beyond the level
constexpr double Better = 0.5;           // of the squares beyond the level must go
}

double findClipLevel(const FieldData& data, const FieldModel& model, const FieldLoop& loop)
{
  using Pixel = std::pair<double, double>; // model, real
  FieldModel open = model;
  open[ImageParameter::Clip].setZero();
  const Eigen::ArrayXd glare = sceneMean(data, open);
  std::vector<std::vector<Pixel>> parts(data.blocks.size());
  loop(static_cast<int>(data.blocks.size()),
    [&](int b)
    {
      const FieldBlock& block = data.blocks[static_cast<std::size_t>(b)];
      FieldScratch scratch;
      for (Eigen::Index k = 0; block.fold >= 0 && k < data.channels(); ++k)
      {
        fieldColumns(data, open, glare, block, k, scratch);
        for (Eigen::Index n = 0; n < scratch.level.size(); ++n)
        {
          const double level = scratch.level[n];
          parts[static_cast<std::size_t>(b)].emplace_back(
            level, level + scratch.columns(n, FieldColumn::residual()));
        }
      }
    });
  std::vector<Pixel> pixels;
  for (const std::vector<Pixel>& part : parts)
  {
    pixels.insert(pixels.end(), part.begin(), part.end());
  }
  std::sort(pixels.begin(), pixels.end(), [](const Pixel& a, const Pixel& b) { return a > b; });
  // From the brightest down: the mean of the real values beyond a level is the level.
  double n = 0.0;
  double sum = 0.0;
  double square = 0.0;
  double before = 0.0;
  double most = 0.0;
  double best = neutralValue(ImageParameter::ClipLevel);
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

} // namespace msi

#include "Kernels/Gap/Field/FieldStarts.h"
#include "Kernels/Doubts/PairSums.h"

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Numerics/Angle.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
constexpr int Farthest = 10;
constexpr int Side = 2 * Farthest + 1;
constexpr std::size_t ShiftBlocks = 64;
constexpr double BetterCorrelation = 0.002; // of correlation; less is not worth a start elsewhere

// Of a block in one channel: variances and covariance with the scene at each displacement.
struct Match
{
  Eigen::Vector2d place; // middle, from that of the image
  double real;
  Eigen::Array<double, Side, Side> scene, both; // down, right
};

Match matchOf(const FieldData& data, const FieldBlock& block, Eigen::Index channel)
{
  const auto K = static_cast<std::size_t>(data.channels());
  const auto k = static_cast<std::size_t>(channel);
  const ImageExtent& extent = data.pair.extent;
  Match match{ middleOf(data.pair, block.window), 0.0, {}, {} };
  for (int down = -Farthest; down <= Farthest; ++down)
  {
    for (int right = -Farthest; right <= Farthest; ++right)
    {
      PairSums sums;
      std::size_t i = k;
      for (int y = block.window.y; y < block.window.y + block.window.height; ++y)
      {
        const int v = std::clamp(y - down, 0, extent.height - 1);
        for (int x = block.window.x; x < block.window.x + block.window.width; ++x, i += K)
        {
          const int u = std::clamp(x - right, 0, extent.width - 1);
          sums.add(block.real[i], data.scene()[data.pair.index(u, v) * K + k]);
        }
      }
      match.real = sums.ofReal();
      match.scene(down + Farthest, right + Farthest) = sums.ofSimulated();
      match.both(down + Farthest, right + Farthest) = sums.ofBoth();
    }
  }
  return match;
}

// right, down, magnification, rotation in radians
using Similarity = Eigen::RowVector4d;

// Of all blocks; 0 where one of them would move farther than was looked at.
double correlation(const std::vector<Match>& matches, const Similarity& similarity)
{
  double real = 0.0;
  double scene = 0.0;
  double both = 0.0;
  for (const Match& match : matches)
  {
    const auto right = std::lround(
      similarity[0] + similarity[2] * match.place.x() - similarity[3] * match.place.y());
    const auto down = std::lround(
      similarity[1] + similarity[2] * match.place.y() + similarity[3] * match.place.x());
    if (std::max(std::labs(right), std::labs(down)) > Farthest)
    {
      return 0.0;
    }
    real += match.real;
    scene += match.scene(down + Farthest, right + Farthest);
    both += match.both(down + Farthest, right + Farthest);
  }
  return both / std::sqrt(std::fmax(real * scene, 1e-30));
}

struct Best
{
  Similarity at = Similarity::Zero();
  double value = 0.0;
};

// The displacement with the largest correlation within `reach` of that of `around`, which keeps the rest.
void move(const std::vector<Match>& matches, const Similarity& around, int reach, Best& best)
{
  for (int down = -reach; down <= reach; ++down)
  {
    for (int right = -reach; right <= reach; ++right)
    {
      const Similarity at = around + Similarity(right, down, 0.0, 0.0);
      const double value = correlation(matches, at);
      if (value > best.value)
      {
        best = { at, value };
      }
    }
  }
}
}

FieldStart registrationStart(const FieldData& data, const FieldLoop& loop)
{
  std::vector<const FieldBlock*> blocks;
  for (const FieldBlock& block : data.blocks)
  {
    if (block.fold >= 0 && blocks.size() < ShiftBlocks)
    {
      blocks.push_back(&block);
    }
  }
  const double step = 2.0 / std::max(data.pair.extent.width, data.pair.extent.height);
  FieldStart start{ Eigen::MatrixXd::Zero(data.channels(), 4),
    Eigen::MatrixXd::Zero(data.channels(), 4) };
  loop(static_cast<int>(data.channels()),
    [&](int channel)
    {
      std::vector<Match> matches;
      matches.reserve(blocks.size());
      for (const FieldBlock* block : blocks)
      {
        matches.push_back(matchOf(data, *block, channel));
      }
      Best best{ Similarity::Zero(), correlation(matches, Similarity::Zero()) + BetterCorrelation };
      move(matches, Similarity::Zero(), Farthest, best);
      start.shift.row(channel) = best.at;
      // A pixel more at the end of the longer side with each step.
      best.value += BetterCorrelation;
      for (const int parameter : { 3, 2 })
      {
        const Similarity around = best.at;
        for (int i = -Farthest; i <= Farthest; ++i)
        {
          Similarity at = around;
          at[parameter] += i * step;
          move(matches, at, parameter == 3 && around.isZero() ? 4 : 1, best);
        }
      }
      start.similarity.row(channel) = best.at;
      start.similarity(channel, 3) /= Degree;
    });
  return start;
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

double findClipLevel(const std::vector<FieldResidual>& residuals)
{
  using Pixel = std::pair<double, double>; // model, real
  std::vector<Pixel> pixels;
  for (const FieldResidual& part : residuals)
  {
    for (Eigen::Index n = 0; n < part.level.size(); ++n)
    {
      pixels.emplace_back(part.level[n], part.level[n] + part.residual[n]);
    }
  }
  std::sort(pixels.begin(), pixels.end(), [](const Pixel& a, const Pixel& b) { return a > b; });
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

} // namespace msi

#include "Kernels/Gap/Field/FieldShift.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int Farthest = 10;
constexpr std::size_t MostBlocks = 64;
constexpr double Better = 0.002; // of correlation; less is not worth a start elsewhere

double correlation(const FieldData& data, const std::vector<std::size_t>& blocks,
  Eigen::Index channel, int right, int down)
{
  const auto K = static_cast<std::size_t>(data.channels());
  const auto k = static_cast<std::size_t>(channel);
  const ImageExtent& extent = data.pair.extent;
  double rr = 0.0;
  double ss = 0.0;
  double rs = 0.0;
  for (const std::size_t b : blocks)
  {
    const FieldBlock& block = data.blocks[b];
    double n = 0.0;
    double r = 0.0;
    double s = 0.0;
    double r2 = 0.0;
    double s2 = 0.0;
    double both = 0.0;
    std::size_t i = k;
    for (int y = block.window.y; y < block.window.y + block.window.height; ++y)
    {
      const int v = std::clamp(y - down, 0, extent.height - 1);
      for (int x = block.window.x; x < block.window.x + block.window.width; ++x, i += K)
      {
        const auto real = static_cast<double>(block.real[i]);
        if (std::isfinite(real))
        {
          const int u = std::clamp(x - right, 0, extent.width - 1);
          const auto scene = static_cast<double>(data.scene[data.pair.index(u, v) * K + k]);
          n += 1.0;
          r += real;
          s += scene;
          r2 += real * real;
          s2 += scene * scene;
          both += real * scene;
        }
      }
    }
    n = std::fmax(n, 1.0);
    rr += r2 - r * r / n;
    ss += s2 - s * s / n;
    rs += both - r * s / n;
  }
  return rs / std::sqrt(std::fmax(rr * ss, 1e-30));
}
}

Eigen::MatrixXd wholePixelShifts(const FieldData& data, const FieldLoop& loop)
{
  std::vector<std::size_t> blocks;
  for (std::size_t b = 0; b < data.blocks.size() && blocks.size() < MostBlocks; ++b)
  {
    if (data.blocks[b].fold >= 0)
    {
      blocks.push_back(b);
    }
  }
  Eigen::MatrixXd shifts = Eigen::MatrixXd::Zero(data.channels(), 2);
  loop(static_cast<int>(data.channels()),
    [&](int channel)
    {
      const double still = correlation(data, blocks, channel, 0, 0);
      double best = still + Better;
      for (int down = -Farthest; down <= Farthest; ++down)
      {
        for (int right = -Farthest; right <= Farthest; ++right)
        {
          const double value = correlation(data, blocks, channel, right, down);
          if (value > best)
          {
            best = value;
            shifts.row(channel) << right, down;
          }
        }
      }
    });
  return shifts;
}

} // namespace msi

#include "Kernels/Gap/Shrink.h"

#include "Kernels/Numerics/CounterRandom.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace msi
{

namespace
{
constexpr int Resamplings = 400;
constexpr std::uint32_t Stream = 72;
}

double shrinkOf(double before, double after, double noise) noexcept
{
  const double excess = before - noise;
  if (!(excess > 0.0))
  {
    return 0.0;
  }
  return std::fmax(1.0 - std::sqrt(std::fmax(after - noise, 0.0) / excess), -1.0);
}

double sumOf(const std::vector<double>& values) noexcept
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double shrinkOf(const GroupEnergies& energies)
{
  return shrinkOf(sumOf(energies.before), sumOf(energies.after), sumOf(energies.noise));
}

GapFigures figuresOf(const GroupEnergies& energies, double elements, std::uint64_t seed)
{
  GapFigures figures;
  figures.rmsBefore = std::sqrt(sumOf(energies.before) / elements);
  figures.rmsAfter = std::sqrt(sumOf(energies.after) / elements);
  figures.noiseFloor = std::sqrt(sumOf(energies.noise) / elements);
  figures.shrink = shrinkOf(energies);
  figures.shrinkInterval = shrinkInterval(energies, seed);
  figures.shrinkInterval[0] = std::fmin(figures.shrinkInterval[0], figures.shrink);
  figures.shrinkInterval[1] = std::fmax(figures.shrinkInterval[1], figures.shrink);
  return figures;
}

std::array<double, 2> shrinkInterval(const GroupEnergies& energies, std::uint64_t seed)
{
  const std::size_t count = energies.before.size();
  if (count == 0)
  {
    return { 0.0, 0.0 };
  }
  const CounterRandom random(seed, Stream);
  std::vector<double> shrinks;
  for (int draw = 0; draw < Resamplings; ++draw)
  {
    double before = 0.0;
    double after = 0.0;
    double noise = 0.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto index = static_cast<std::uint64_t>(draw) * count + i;
      const auto pick = std::min(
        count - 1, static_cast<std::size_t>(random.uniform(index) * static_cast<double>(count)));
      before += energies.before[pick];
      after += energies.after[pick];
      noise += energies.noise[pick];
    }
    shrinks.push_back(shrinkOf(before, after, noise));
  }
  std::sort(shrinks.begin(), shrinks.end());
  return { shrinks[Resamplings / 40], shrinks[Resamplings - 1 - Resamplings / 40] };
}

std::vector<double> shapleyValues(const std::vector<double>& value, std::size_t players)
{
  // (others)! (players - others - 1)! / players! for a coalition of so many others.
  const auto weight = [players](std::size_t others)
  {
    double part = 1.0 / static_cast<double>(players);
    for (std::size_t n = 1; n <= others; ++n)
    {
      part *= static_cast<double>(n) / static_cast<double>(players - n);
    }
    return part;
  };
  std::vector<double> share;
  for (std::size_t p = 0; p < players; ++p)
  {
    double sum = 0.0;
    for (std::size_t subset = 0; subset < value.size(); ++subset)
    {
      if ((subset >> p & 1U) == 0)
      {
        const std::size_t others = std::bitset<64>(subset).count();
        sum += weight(others) * (value[subset | std::size_t(1) << p] - value[subset]);
      }
    }
    share.push_back(sum);
  }
  return share;
}

} // namespace msi

#include "Kernels/Gap/ShrinkInterval.h"

#include "Kernels/Camera/CounterRandom.h"
#include "Kernels/Gap/GapCauses.h"

#include <algorithm>
#include <cstddef>

namespace msi
{

namespace
{
constexpr int Resamplings = 400;
constexpr std::uint32_t Stream = 72;
}

std::array<double, 2> shrinkInterval(const SampleEnergies& energies, std::uint64_t seed)
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

} // namespace msi

// How far resampling the samples moves a shrink.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace msi
{

// Energies of the gap, one a sample; equal lengths.
struct SampleEnergies
{
  std::vector<double> before, after, noise;
};

// 95 % interval of shrinkOf over bootstrap draws of the samples; {0, 0} without samples.
std::array<double, 2> shrinkInterval(const SampleEnergies& energies, std::uint64_t seed);

} // namespace msi

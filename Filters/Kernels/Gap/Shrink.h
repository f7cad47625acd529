// How far a gap shrinks.
#pragma once

#include "Kernels/Gap/GapReport.h"

#include <array>
#include <cstdint>
#include <vector>

namespace msi
{

// Energies of the gap, one of each group of data that are held out together (a sample, neighbouring blocks of an image);
// equal lengths. Plain response units.
struct GroupEnergies
{
  std::vector<double> before, after, noise;
};

// 1 - sqrt(excess energy left / excess energy before), within [-1, 1]; 0 where there was none.
double shrinkOf(double before, double after, double noise) noexcept;
double shrinkOf(const GroupEnergies& energies);

// Over so many elements. seed: of the interval, which contains the shrink itself.
GapFigures figuresOf(const GroupEnergies& energies, double elements, std::uint64_t seed);

// 95 % interval of shrinkOf over bootstrap draws of the groups; {0, 0} without groups.
std::array<double, 2> shrinkInterval(const GroupEnergies& energies, std::uint64_t seed);

} // namespace msi

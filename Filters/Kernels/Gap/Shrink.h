// How far a gap shrinks, and how much of that each of several has done.
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

double sumOf(const std::vector<double>& values) noexcept;

// 1 - sqrt(excess energy left / excess energy before), within [-1, 1]; 0 where there was none.
double shrinkOf(double before, double after, double noise) noexcept;
double shrinkOf(const GroupEnergies& energies);

// Over so many elements. seed: of the interval, which contains the shrink itself.
GapFigures figuresOf(const GroupEnergies& energies, double elements, std::uint64_t seed);

// 95 % interval of shrinkOf over bootstrap draws of the groups; {0, 0} without groups.
std::array<double, 2> shrinkInterval(const GroupEnergies& energies, std::uint64_t seed);

// Shapley values: value[subset] is what the players in the bits of `subset` achieve; 2^players values, of which
// value[0] is what none achieves. The values of all players sum to value[all] - value[0].
// Source: L. S. Shapley, "A value for n-person games", 1953, doi:10.1515/9781400881970-018.
std::vector<double> shapleyValues(const std::vector<double>& value, std::size_t players);

} // namespace msi

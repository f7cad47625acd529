// How far a gap shrinks.
#pragma once

#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/EffectFit.h"

#include <array>
#include <cstdint>
#include <vector>

namespace msi
{

// Energies of the gap, one a sample; equal lengths. Plain response units.
struct SampleEnergies
{
  std::vector<double> before, after, noise;
};

// Of the training samples, cross-validated.
SampleEnergies energiesOf(const EffectFitter& fitter, const EffectFit& fit);

// 1 - sqrt(excess energy left / excess energy before), within [-1, 1]; 0 where there was none.
double shrinkOf(double before, double after, double noise) noexcept;
double shrinkOf(const EffectFitter& fitter, const EffectFit& fit);

// Over so many elements. seed: of the interval, which contains the shrink itself.
GapFigures figuresOf(const SampleEnergies& energies, double elements, std::uint64_t seed);

// 95 % interval of shrinkOf over bootstrap draws of the samples; {0, 0} without samples.
std::array<double, 2> shrinkInterval(const SampleEnergies& energies, std::uint64_t seed);

} // namespace msi

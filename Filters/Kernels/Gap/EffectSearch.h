// Which set of effects explains a gap.
#pragma once

#include "Kernels/Gap/EffectFit.h"
#include "Kernels/Gap/EffectScreen.h"

#include <functional>
#include <vector>

namespace msi
{

struct SearchLimits
{
  int maximumEffects = 5;
  int width = 3;             // sets kept of each size
  int fullFits = 12;         // effects fitted for each set kept
  bool exchangePairs = true; // other effects in the place of two, not of one only
};

struct SearchResult
{
  EffectFit best;
  std::size_t causes =
    0; // the effects of `best` up to here are causes, those after it small errors of the camera
  std::vector<EffectFit> singles; // single effects that were fitted; the best form of each
  double gapEnergy = 0.0;         // weighted, beyond noise, before any effect
};

// Beam search by size, among sets that do different things; a set of one effect more must beat the best smaller one by significance, by the price of
// its parameters and by a relevant part of the gap. Afterwards effects are dropped again where that
// costs nothing, and the forms of those that stay are chosen by cross-validation alone.
// stop() is asked now and then; true ends the search early.
SearchResult searchEffects(const EffectFitter& fitter, const std::vector<EffectChoice>& choices,
  const SearchLimits& limits, const std::function<bool()>& stop);

} // namespace msi

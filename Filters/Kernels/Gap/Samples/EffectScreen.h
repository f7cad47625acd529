// Which effects are worth a full fit.
#pragma once

#include "Kernels/Gap/Samples/EffectFit.h"

#include <vector>

namespace msi
{

struct ScreenedEffect
{
  EffectChoice choice;
  std::vector<double> start; // one number a parameter of the form; empty: neutral
  double gain = 0.0;         // of weighted squared error, by the linear prediction
  Eigen::Index parameters = 0;
};

// Every choice that is not in the fit yet, by what one linear step with it would explain beyond the effects
// already there; the largest gain less the price of its parameters first. Forms with several starting
// points keep the best; steps in time start where the cumulative sums of the residual break.
std::vector<ScreenedEffect> screenEffects(const EffectFitter& fitter, const EffectFit& current,
  const std::vector<EffectChoice>& choices, double pricePerParameter);

} // namespace msi

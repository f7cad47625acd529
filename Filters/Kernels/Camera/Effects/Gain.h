// A factor on every channel, whichever effect it is.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

inline std::unique_ptr<BlockOperator> makeGain(const BoundEffect& effect)
{
  return onAll([](auto u, const auto& gain) { u.colwise() *= gain; },
    ChannelValues(effect.perChannel("gain")));
}

inline double amplify(const double* numbers, const ImagePixel&, double& signal, double* by)
{
  signal *= numbers[0];
  if (by != nullptr)
  {
    by[0] = signal; // relative to the gain
  }
  return numbers[0];
}

inline void relativeToGain(int, const double* numbers, const double*, double* derivatives)
{
  derivatives[0] = 1.0 / numbers[0];
}

inline const ImageStep& gainStep()
{
  static const ImageStep step{ ImageStage::Detector,
    { { 1.0, ImageAxis::Channel | ImageAxis::Level } }, amplify, {}, relativeToGain };
  return step;
}

} // namespace msi

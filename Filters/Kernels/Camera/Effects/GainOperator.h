// A factor on every channel.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

class GainOperator : public BlockOperatorOf<GainOperator>
{
public:
  explicit GainOperator(const BoundEffect& effect)
    : Gain(effect.perChannel("gain"))
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> signal, const ColumnContext&) const noexcept
  {
    signal.array().colwise() *= Gain.as<Scalar>();
  }

private:
  ChannelValues Gain;
};

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

// One gain of each channel, whichever effect it is.
inline const ImageStep& gainStep()
{
  static const ImageStep step{ ImageStage::Detector,
    { { 1.0, ImageAxis::Channel | ImageAxis::Level } }, amplify, {}, relativeToGain };
  return step;
}

} // namespace msi

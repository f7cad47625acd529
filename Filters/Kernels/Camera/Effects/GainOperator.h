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

} // namespace msi

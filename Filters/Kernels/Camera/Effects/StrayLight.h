// A signal mixed with that of its surround.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

// u + fraction surround, or + fraction (surround - u) where light only changes its place.
class StrayLight : public SurroundOperatorOf<StrayLight>
{
public:
  explicit StrayLight(const BoundEffect& effect)
    : Fraction(effect.perChannel("fraction"))
    , Added(effect.form().name == "common" || effect.form().name == "per_channel")
    , Reach(effect.form().name == "tail" ? effect.value("reach") : 0.0)
  {
  }
  double reach() const noexcept override { return Reach; }
  template <typename Scalar>
  void run(Block<Scalar> signal, ConstBlock<Scalar> surround) const noexcept
  {
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      auto u = signal.col(j).array();
      if (Added)
      {
        u += Fraction.as<Scalar>() * surround.col(j).array();
      }
      else
      {
        u += Fraction.as<Scalar>() * (surround.col(j).array() - u);
      }
    }
  }

private:
  ChannelValues Fraction;
  bool Added;
  double Reach;
};

} // namespace msi

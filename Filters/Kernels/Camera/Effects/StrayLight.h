// A signal mixed with that of its surround.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

#include <algorithm>
#include <cmath>

namespace msi
{

// Shares of the light in a tail of any shape: all parameters of its form.
inline Eigen::ArrayXd sharesOf(const BoundEffect& effect)
{
  const std::vector<EffectParameter>& parameters = effect.form().parameters;
  Eigen::ArrayXd shares(static_cast<Eigen::Index>(parameters.size()));
  std::transform(parameters.begin(), parameters.end(), shares.begin(),
    [&effect](const EffectParameter& share) { return effect.value(share.name); });
  return shares;
}

// Their sum; where they cancel, as little as leaves shares of it finite.
inline double totalOf(const Eigen::ArrayXd& shares)
{
  const double sum = shares.sum();
  return std::copysign(std::fmax(std::fabs(sum), 1e-6), sum);
}

// u + fraction surround, or + fraction (surround - u) where light only changes its place.
class StrayLight : public SurroundOperatorOf<StrayLight>
{
public:
  explicit StrayLight(const BoundEffect& effect)
    : Fraction(effect.form().name == "any_shape"
          ? Eigen::ArrayXd::Constant(effect.camera().channelCount(), totalOf(sharesOf(effect)))
          : effect.perChannel("fraction"))
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

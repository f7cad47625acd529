// Factors over the field.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

// Multiplies channel k of every column by Derived::factor(k, x, y), or all channels alike.
template <typename Derived>
class FieldOperator : public BlockOperatorOf<Derived>
{
public:
  explicit FieldOperator(const BoundEffect& effect)
    : OfChannels(effect.form().name == "per_channel")
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      const auto factor = [&](Eigen::Index k)
      {
        return static_cast<Scalar>(
          static_cast<const Derived*>(this)->factor(k, columns.fieldX[j], columns.fieldY[j]));
      };
      if (!OfChannels)
      {
        signal.col(j) *= factor(0);
        continue;
      }
      for (Eigen::Index k = 0; k < signal.rows(); ++k)
      {
        signal(k, j) *= factor(k);
      }
    }
  }

private:
  bool OfChannels;
};

} // namespace msi

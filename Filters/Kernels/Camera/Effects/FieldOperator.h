// Factors over the field.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

// Multiplies every column by Derived::factor(x, y).
template <typename Derived>
class FieldOperator : public BlockOperatorOf<Derived>
{
public:
  template <typename Scalar>
  void run(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      signal.col(j) *= static_cast<Scalar>(
        static_cast<const Derived*>(this)->factor(columns.fieldX[j], columns.fieldY[j]));
    }
  }
};

} // namespace msi

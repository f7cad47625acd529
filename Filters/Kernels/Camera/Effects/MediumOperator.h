// Operators on the reflectance of one medium.
#pragma once

#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

// Calls Derived::change(column) for the columns of one medium.
template <typename Derived>
class MediumOperator : public BlockOperatorOf<Derived>
{
public:
  explicit MediumOperator(const BoundEffect& effect)
    : Medium(effect.medium())
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> reflectance, const ColumnContext& columns) const noexcept
  {
    for (Eigen::Index j = 0; j < reflectance.cols(); ++j)
    {
      if (columns.medium[j] == Medium)
      {
        static_cast<const Derived*>(this)->template change<Scalar>(reflectance.col(j).array());
      }
    }
  }

private:
  int Medium;
};

} // namespace msi

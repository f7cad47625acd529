// Normal equations of parameters of which many move one channel only.
#pragma once

#include "Kernels/Gap/Samples/EffectSet.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// J^T W J over the samples named, p x p.
// jacobian: KS x p, rows in the order of a K x S response; weight: K x S; free: one a column.
// reach: how many channels away a parameter of one channel acts. Where it is zero the cost grows with the number of
//   parameters a channel has, not with that of all.
Eigen::MatrixXd normalMatrix(const Eigen::MatrixXd& jacobian,
  const Eigen::Ref<const Eigen::ArrayXXd>& weight, const std::vector<FreeParameter>& free,
  Eigen::Index reach, const std::vector<Eigen::Index>& samples);

} // namespace msi

#include "Kernels/Numerics/ThinSvd.h"

#include <Eigen/SVD>

namespace msi
{

ThinSvd thinSvd(const Eigen::MatrixXd& a)
{
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return { svd.matrixU(), svd.singularValues(), svd.matrixV() };
}

} // namespace msi

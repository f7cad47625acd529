// Singular value decomposition, apart so that only one file compiles Eigen's.
#pragma once

#include <Eigen/Core>

namespace msi
{

// a = left diag(singular) right', singular values falling; r = min(rows, columns).
struct ThinSvd
{
  Eigen::MatrixXd left;     // rows x r
  Eigen::VectorXd singular; // r
  Eigen::MatrixXd right;    // columns x r
};

// a must be finite. Method: Eigen::JacobiSVD (Eigen::BDCSVD compiles three times as long).
ThinSvd thinSvd(const Eigen::MatrixXd& a);

} // namespace msi

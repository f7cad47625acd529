// Lower triangles of a few hundred rows: the inverse of a Cholesky factor, products, normal equations. Where fits spend their time.
#pragma once

#include <Eigen/Core>

namespace msi
{

// Every instruction set rounds the same way: terms are added in order, each rounded before. 'sum' and 'work' share no element
// with the other matrices; 'lower' is a lower triangle with zeros above.

// Turns the lower triangle of a symmetric matrix into the inverse of its Cholesky factor, with zeros above the diagonal, where
// nothing is read; writes the diagonal of the factor itself. 'work' is at least as large as 'matrix'.
// False where the matrix is not numerically positive; what is in it then is of no use.
bool invertFactor(Eigen::Ref<Eigen::MatrixXd> matrix, Eigen::Ref<Eigen::VectorXd> diagonal,
  Eigen::Ref<Eigen::MatrixXd> work);

// sum += a l; sum += a l'.
void addTimesLower(Eigen::Ref<Eigen::MatrixXd> sum, const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& lower);
void addTimesTransposedLower(Eigen::Ref<Eigen::MatrixXd> sum,
  const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& lower);

// sum += a b'; sum += l' l: the lower triangle, what is above it is lost.
void addOuterProduct(Eigen::Ref<Eigen::MatrixXd> sum, const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& b);
void addSquare(Eigen::Ref<Eigen::MatrixXd> sum, const Eigen::Ref<const Eigen::MatrixXd>& lower,
  Eigen::Ref<Eigen::MatrixXd> work);

} // namespace msi

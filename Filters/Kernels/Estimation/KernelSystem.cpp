#include "Kernels/Estimation/KernelSystem.h"

#include <Eigen/Cholesky>

namespace msi
{

KernelSolution solveKernelSystem(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& outputs,
  const Eigen::VectorXd& weights, double lambda)
{
  const Eigen::Index n = gram.rows();
  Eigen::MatrixXd system = gram;
  system.diagonal() += lambda * weights.cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(system);
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd ofOne = inverse.rowwise().sum();
  const double total = ofOne.sum();
  KernelSolution solution;
  solution.constant = (ofOne.transpose() * outputs / total).transpose();
  solution.coefficients = inverse * outputs - ofOne * solution.constant.transpose();
  const Eigen::VectorXd diagonal = inverse.diagonal() - ofOne.cwiseAbs2() / total;
  solution.leftOutError = diagonal.cwiseInverse().asDiagonal() * solution.coefficients;
  return solution;
}

} // namespace msi

#include "Kernels/Numerics/Lasso.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace msi
{

namespace
{
constexpr int MostRounds = 200;
constexpr int SweepsPerRound = 20;
// Of the penalty and the largest gradient, by which an optimality condition may miss.
constexpr double Slack = 1e-9;
// Of the cost, by which a round has to lower it.
constexpr double LeastGain = 1e-6;

double softened(double value, double penalty) noexcept
{
  return std::copysign(std::max(std::abs(value) - penalty, 0.0), value);
}

struct LassoProblem
{
  const Eigen::MatrixXd& a;
  Eigen::VectorXd b;
  double penalty;
};

void sweep(const LassoProblem& problem, Eigen::VectorXd& w, Eigen::VectorXd& gradient)
{
  for (Eigen::Index k = 0; k < w.size(); ++k)
  {
    const double curvature = problem.a(k, k);
    if (!(curvature > 0.0))
    {
      continue;
    }
    const double next = softened(gradient[k] + curvature * w[k], problem.penalty) / curvature;
    if (next != w[k])
    {
      gradient -= (next - w[k]) * problem.a.col(k);
      w[k] = next;
    }
  }
}

// The minimum if the coefficients that are not zero, and their signs, are those of w; returns whether
// it is the minimum over all coefficients.
bool solveActive(const LassoProblem& problem, Eigen::VectorXd& w, Eigen::VectorXd& gradient)
{
  std::vector<Eigen::Index> active;
  for (Eigen::Index k = 0; k < w.size(); ++k)
  {
    if (w[k] != 0.0)
    {
      active.push_back(k);
    }
  }
  const Eigen::MatrixXd a = problem.a(active, active);
  const Eigen::VectorXd signs = w(active).cwiseSign();
  const Eigen::VectorXd solved = a.ldlt().solve(problem.b(active) - problem.penalty * signs);
  if (!solved.allFinite() || (solved.array() * signs.array() < 0.0).any())
  {
    return false;
  }
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(w.size());
  exact(active) = solved;
  const Eigen::VectorXd slope = problem.b - problem.a * exact;
  const double allowed =
    problem.penalty + Slack * (problem.penalty + problem.b.cwiseAbs().maxCoeff());
  if ((slope.cwiseAbs().array() > allowed).any())
  {
    return false;
  }
  w = exact;
  gradient = slope;
  return true;
}

Eigen::VectorXd solveOne(const LassoProblem& problem)
{
  Eigen::VectorXd w = Eigen::VectorXd::Zero(problem.b.size());
  Eigen::VectorXd gradient = problem.b; // b - A w
  double cost = 0.0;
  for (int round = 0; round < MostRounds; ++round)
  {
    for (int i = 0; i < SweepsPerRound; ++i)
    {
      sweep(problem, w, gradient);
    }
    if (solveActive(problem, w, gradient))
    {
      break;
    }
    // Channels that hardly differ: their coefficients move on for ever, and nothing gets better.
    const double before = cost;
    cost = problem.penalty * w.cwiseAbs().sum() - 0.5 * w.dot(problem.b + gradient);
    if (before - cost <= LeastGain * std::abs(cost))
    {
      break;
    }
  }
  return w;
}
}

Eigen::MatrixXd solveLasso(
  const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& penalty)
{
  Eigen::MatrixXd w(a.rows(), b.cols());
  for (Eigen::Index n = 0; n < b.cols(); ++n)
  {
    w.col(n) = solveOne({ a, b.col(n), penalty[n] });
  }
  return w;
}

} // namespace msi

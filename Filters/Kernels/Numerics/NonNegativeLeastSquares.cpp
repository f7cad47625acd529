#include "Kernels/Numerics/NonNegativeLeastSquares.h"

#include "Kernels/Spectra/Reject.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <vector>

namespace msi
{

namespace
{
constexpr double Tolerance = 1e-12;
constexpr int StepsPerCoefficient = 10;

std::vector<Eigen::Index> listOf(const std::vector<bool>& passive)
{
  std::vector<Eigen::Index> list;
  for (std::size_t i = 0; i < passive.size(); ++i)
  {
    if (passive[i])
    {
      list.push_back(static_cast<Eigen::Index>(i));
    }
  }
  return list;
}
}

NonNegativeSolution solveNonNegative(const Eigen::MatrixXd& h, const Eigen::VectorXd& f)
{
  const Eigen::Index count = f.size();
  if (h.rows() != count || h.cols() != count)
  {
    reject("non-negative least squares has a matrix of ", h.rows(), " x ", h.cols(),
      " and a right side of ", count);
  }
  NonNegativeSolution solution{ Eigen::VectorXd::Zero(count) };
  Eigen::VectorXd& x = solution.x;
  if (count == 0)
  {
    return solution;
  }
  std::vector<bool> passive(static_cast<std::size_t>(count), false);
  // Candidates that rounding alone made look like growing; until x changes.
  std::vector<bool> idle(static_cast<std::size_t>(count), false);
  const double small = Tolerance * f.cwiseAbs().maxCoeff();
  const int limit = StepsPerCoefficient * static_cast<int>(count);

  while (true)
  {
    // The coefficient at zero that most wants to grow.
    const Eigen::VectorXd gradient = f - h * x;
    Eigen::Index entering = -1;
    double steepest = small;
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const auto position = static_cast<std::size_t>(i);
      if (!passive[position] && !idle[position] && gradient[i] > steepest)
      {
        steepest = gradient[i];
        entering = i;
      }
    }
    if (entering < 0)
    {
      return solution;
    }
    passive[static_cast<std::size_t>(entering)] = true;

    for (bool first = true;; first = false)
    {
      if (++solution.steps > limit)
      {
        solution.converged = false;
        return solution;
      }
      const std::vector<Eigen::Index> list = listOf(passive);
      const Eigen::VectorXd step = h(list, list).ldlt().solve(f(list));
      const auto entered = std::find(list.begin(), list.end(), entering);
      if (first && step[entered - list.begin()] <= 0.0)
      {
        passive[static_cast<std::size_t>(entering)] = false;
        idle[static_cast<std::size_t>(entering)] = true;
        break;
      }
      std::fill(idle.begin(), idle.end(), false);
      // Go towards the unconstrained solution until the first coefficient meets zero.
      double reach = 1.0;
      for (std::size_t i = 0; i < list.size(); ++i)
      {
        const double target = step[static_cast<Eigen::Index>(i)];
        const double here = x[list[i]];
        if (target <= 0.0 && here - target > 0.0)
        {
          reach = std::min(reach, here / (here - target));
        }
      }
      bool left = false;
      for (std::size_t i = 0; i < list.size(); ++i)
      {
        const double target = step[static_cast<Eigen::Index>(i)];
        double& here = x[list[i]];
        here += reach * (target - here);
        if (target <= 0.0 && here <= small)
        {
          here = 0.0;
          passive[static_cast<std::size_t>(list[i])] = false;
          left = true;
        }
      }
      if (!left)
      {
        break;
      }
    }
  }
}

} // namespace msi

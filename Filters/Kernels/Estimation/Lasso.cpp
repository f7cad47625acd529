#include "Kernels/Estimation/Lasso.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int MostSweeps = 10000;
constexpr double SmallestGain = 1e-14;

double softened(double value, double penalty) noexcept
{
  return std::copysign(std::max(std::abs(value) - penalty, 0.0), value);
}

Eigen::VectorXd solveOne(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double penalty)
{
  Eigen::VectorXd w = Eigen::VectorXd::Zero(b.size());
  Eigen::VectorXd gradient = b; // b - A w
  double scale = 0.0;
  for (Eigen::Index k = 0; k < b.size(); ++k)
  {
    scale = a(k, k) > 0.0 ? std::max(scale, b[k] * b[k] / a(k, k)) : scale;
  }
  for (int sweep = 0; sweep < MostSweeps; ++sweep)
  {
    double gain = 0.0;
    for (Eigen::Index k = 0; k < b.size(); ++k)
    {
      if (!(a(k, k) > 0.0))
      {
        continue;
      }
      const double next = softened(gradient[k] + a(k, k) * w[k], penalty) / a(k, k);
      const double step = next - w[k];
      if (step != 0.0)
      {
        gain = std::max(gain, a(k, k) * step * step);
        gradient -= step * a.col(k);
        w[k] = next;
      }
    }
    if (gain <= SmallestGain * scale)
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
    w.col(n) = solveOne(a, b.col(n), penalty[n]);
  }
  return w;
}

} // namespace msi

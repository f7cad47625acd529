#include "Kernels/Gap/Samples/HeldOut.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msi
{

namespace
{
Eigen::MatrixXd leftBy(const GapData& data, const Eigen::MatrixXd& predicted)
{
  return (data.count.array() > 0.0).select(data.observed - predicted, 0.0);
}
}

Eigen::MatrixXd leftOfHeldOut(
  const GapData& data, const EffectFit& fit, const std::vector<char>& training)
{
  Eigen::MatrixXd left = leftBy(data, fit.predicted);
  const double none = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < fit.set.size(); ++e)
  {
    const auto step = fit.set.placeOf(e);
    if (!step)
    {
      continue;
    }
    const Eigen::VectorXd& time = data.scene.time();
    const double place = fit.set.effects[e].parameters[step->index];
    double before = -none;
    double behind = none;
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      if (training[static_cast<std::size_t>(i)] != 0)
      {
        before = time[i] <= place ? std::fmax(before, time[i]) : before;
        behind = time[i] > place ? std::fmin(behind, time[i]) : behind;
      }
    }
    const double half = 0.5 * fit.set.effects[e].parameters[step->index + 1];
    for (const double end : { before - half, behind + half })
    {
      EffectSet moved = fit.set;
      moved.effects[e].parameters[step->index] = std::clamp(end, 0.0, 1.0);
      const Eigen::MatrixXd other = leftBy(data, respond(data.camera, data.scene, moved));
      for (Eigen::Index i = 0; i < data.samples(); ++i)
      {
        if (time[i] > before && time[i] < behind &&
          other.col(i).squaredNorm() < left.col(i).squaredNorm())
        {
          left.col(i) = other.col(i);
        }
      }
    }
  }
  return left;
}

} // namespace msi

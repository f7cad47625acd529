#include "Kernels/Camera/Effects/TailWeights.h"

#include "Kernels/Camera/Effects/ColumnSumKernel.h"

#include <cmath>
#include <utility>

namespace msi
{

TailWeights::TailWeights(const SampleScene& scene, double reach, std::vector<char> usable)
  : Reach(reach)
  , Usable(std::move(usable))
{
  std::vector<double> weight;
  weight.reserve(scene.distances().size());
  for (const double pitches : scene.distances())
  {
    weight.push_back(std::exp(-pitches / reach));
  }
  for (const std::vector<SampleScene::Other>& surround : scene.surround())
  {
    First.push_back(Others.size());
    Sums.push_back(0.0);
    for (const SampleScene::Other& other : surround)
    {
      if (Usable[static_cast<std::size_t>(other.sample)] != 0)
      {
        Others.push_back(other.sample);
        Weights.push_back(weight[static_cast<std::size_t>(other.distance)]);
        Sums.back() += Weights.back();
      }
    }
  }
  First.push_back(Others.size());
}

Eigen::MatrixXd TailWeights::mean(const Eigen::MatrixXd& signal) const
{
  Eigen::MatrixXd surround(signal.rows(), signal.cols());
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    const std::size_t first = First[static_cast<std::size_t>(j)];
    const std::size_t end = First[static_cast<std::size_t>(j) + 1];
    const double sum = Sums[static_cast<std::size_t>(j)];
    if (sum > 0.0)
    {
      weightedColumnSum(signal.data(), static_cast<std::size_t>(signal.rows()),
        Others.data() + first, Weights.data() + first, end - first, surround.col(j).data());
      surround.col(j) /= sum;
    }
    else
    {
      surround.col(j) = signal.col(j);
    }
  }
  return surround;
}

} // namespace msi

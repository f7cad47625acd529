#include "Kernels/Gap/Diagnosis/LearnedPrior.h"

#include "Kernels/Gap/Diagnosis/ChannelStructure.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace msi
{

namespace
{
constexpr double LeastDeviation = 1e-6; // of the typical size
}

LearnedPrior::LearnedPrior(const std::vector<FreeNumber>& numbers)
{
  const auto count = static_cast<Eigen::Index>(numbers.size());
  covariance = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index first = 0; first < count;)
  {
    const FreeNumber& number = numbers[static_cast<std::size_t>(first)];
    Eigen::Index size = 1;
    while (
      first + size < count && numbers[static_cast<std::size_t>(first + size)].group == number.group)
    {
      ++size;
    }
    auto block = covariance.block(first, first, size, size);
    const double variance = number.spread * number.spread;
    if (!number.perChannel)
    {
      block.diagonal().setConstant(variance);
    }
    else
    {
      Eigen::ArrayXd deviation(size);
      for (Eigen::Index p = 0; p < size; ++p)
      {
        deviation[p] = numbers[static_cast<std::size_t>(first + p)].deviation;
      }
      if (number.ownMean)
      {
        deviation -= deviation.mean();
        block.setConstant(variance);
      }
      const double learned =
        std::fmin(deviation.square().mean() + std::pow(LeastDeviation * number.scale, 2), variance);
      block.diagonal().array() += learned;
      surprise += 0.5 * deviation.square().sum() / learned;
      chanceOfCurve = std::fmin(chanceOfCurve, chanceOfCubic(deviation.matrix()));
    }
    first += size;
  }
}

Eigen::VectorXd LearnedPrior::informationOf(const Eigen::MatrixXd& information) const
{
  if (covariance.size() == 0)
  {
    return {};
  }
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
    root.transpose() * information * root, Eigen::EigenvaluesOnly)
    .eigenvalues()
    .cwiseMax(0.0);
}

} // namespace msi

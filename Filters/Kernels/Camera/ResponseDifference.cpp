#include "Kernels/Camera/ResponseDifference.h"

#include "Kernels/Spectra/Reject.h"

#include <cmath>
#include <limits>

namespace msi
{

namespace
{
ChannelDifference differenceOf(const Eigen::Ref<const Eigen::RowVectorXd>& real,
  const Eigen::Ref<const Eigen::RowVectorXd>& simulated)
{
  std::vector<Eigen::Index> finite;
  for (Eigen::Index s = 0; s < real.size(); ++s)
  {
    if (std::isfinite(real[s]) && std::isfinite(simulated[s]))
    {
      finite.push_back(s);
    }
  }
  constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();
  if (finite.empty())
  {
    return { 0, Unknown, Unknown, Unknown, Unknown, Unknown };
  }
  const Eigen::ArrayXd y = real(finite).transpose();
  const Eigen::ArrayXd x = simulated(finite).transpose();
  const double meanX = x.mean();
  const double meanY = y.mean();
  // The mean of equal numbers may differ from them by rounding.
  const bool varies = x.minCoeff() < x.maxCoeff();
  const double gain =
    varies ? ((x - meanX) * (y - meanY)).sum() / (x - meanX).square().sum() : Unknown;
  const double offset = meanY - gain * meanX;
  return { static_cast<Eigen::Index>(finite.size()), (y - x).mean(),
    std::sqrt((y - x).square().mean()), gain, offset,
    std::sqrt((y - gain * x - offset).square().mean()) };
}
}

std::vector<ChannelDifference> responseDifference(
  const Eigen::MatrixXd& real, const Eigen::MatrixXd& simulated)
{
  if (real.rows() != simulated.rows() || real.cols() != simulated.cols())
  {
    reject("the real camera has ", real.rows(), " channels and ", real.cols(),
      " samples, the simulated one ", simulated.rows(), " and ", simulated.cols(),
      "; expected the same");
  }
  std::vector<ChannelDifference> differences;
  for (Eigen::Index k = 0; k < real.rows(); ++k)
  {
    differences.push_back(differenceOf(real.row(k), simulated.row(k)));
  }
  return differences;
}

} // namespace msi

#include "Kernels/Gap/NormalMatrix.h"

#include <cmath>
#include <cstdlib>

namespace msi
{

Eigen::MatrixXd normalMatrix(const Eigen::MatrixXd& jacobian,
  const Eigen::Ref<const Eigen::ArrayXXd>& weight, const std::vector<FreeParameter>& free,
  Eigen::Index reach, const std::vector<Eigen::Index>& samples)
{
  const Eigen::Index channels = weight.rows();
  const auto count = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  std::vector<Eigen::Index> active;
  Eigen::MatrixXd columns;
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    active.clear();
    for (std::size_t p = 0; p < free.size(); ++p)
    {
      if (free[p].channel < 0 || std::abs(free[p].channel - k) <= reach)
      {
        active.push_back(static_cast<Eigen::Index>(p));
      }
    }
    const auto width = static_cast<Eigen::Index>(active.size());
    columns.resize(count, width);
    for (Eigen::Index a = 0; a < width; ++a)
    {
      for (Eigen::Index i = 0; i < count; ++i)
      {
        const Eigen::Index j = samples[static_cast<std::size_t>(i)];
        columns(i, a) =
          std::sqrt(weight(k, j)) * jacobian(j * channels + k, active[static_cast<std::size_t>(a)]);
      }
    }
    const Eigen::MatrixXd product = columns.transpose() * columns;
    for (Eigen::Index a = 0; a < width; ++a)
    {
      for (Eigen::Index b = 0; b < width; ++b)
      {
        normal(active[static_cast<std::size_t>(a)], active[static_cast<std::size_t>(b)]) +=
          product(a, b);
      }
    }
  }
  return normal;
}

} // namespace msi

#include "Kernels/Gap/Samples/NormalMatrix.h"

#include "Kernels/Gap/Samples/ColumnProducts.h"

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
  Eigen::ArrayXd root(count);
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
    for (Eigen::Index i = 0; i < count; ++i)
    {
      root[i] = std::sqrt(weight(k, samples[static_cast<std::size_t>(i)]));
    }
    columns.resize(count, static_cast<Eigen::Index>(active.size()));
    for (std::size_t a = 0; a < active.size(); ++a)
    {
      const double* from = jacobian.col(active[a]).data() + k;
      double* to = columns.col(static_cast<Eigen::Index>(a)).data();
      for (Eigen::Index i = 0; i < count; ++i)
      {
        to[i] = root[i] * from[samples[static_cast<std::size_t>(i)] * channels];
      }
    }
    normal(active, active) += columnProducts(columns);
  }
  return normal;
}

} // namespace msi

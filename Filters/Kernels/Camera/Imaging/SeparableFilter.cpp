#include "Kernels/Camera/Imaging/SeparableFilter.h"

#include "Kernels/Camera/Imaging/RowConvolution.h"

#include <cmath>

namespace msi
{

SymmetricKernel gaussianKernel(const Eigen::ArrayXd& deviations)
{
  const double widest = deviations.size() > 0 ? deviations.maxCoeff() : 0.0;
  const auto reach = static_cast<Eigen::Index>(std::ceil(GaussianCut * widest));
  Eigen::ArrayXXd weights = Eigen::ArrayXXd::Zero(deviations.size(), reach + 1);
  weights.col(0).setOnes();
  for (Eigen::Index k = 0; k < deviations.size(); ++k)
  {
    if (deviations[k] > 0.0)
    {
      const double cut = GaussianCut * deviations[k];
      for (Eigen::Index i = 0; i <= reach; ++i)
      {
        const double t = static_cast<double>(i) / deviations[k];
        weights(k, i) = static_cast<double>(i) <= cut ? std::exp(-0.5 * t * t) : 0.0;
      }
    }
    weights.row(k) /= 2.0 * weights.row(k).sum() - weights(k, 0);
  }
  SymmetricKernel kernel;
  kernel.weights = weights.cast<float>();
  return kernel;
}

void convolve(const SymmetricKernel& kernel, PixelBuffer& buffer)
{
  RowConvolution filter;
  filter.begin(kernel, buffer.window.width, buffer.window.height);
  filterRows(filter, buffer, buffer);
}

} // namespace msi

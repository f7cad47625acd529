#include "Kernels/Difference/CIEDE2000.h"

#include "Kernels/Difference/CIEDE2000Blocks.h"
#include "Kernels/Spectra/Reject.h"

#include <cmath>

namespace msi
{

namespace
{
void requirePositive(double factor, const char* name)
{
  if (!std::isfinite(factor) || !(factor > 0.0))
  {
    reject("the CIEDE2000 factor ", name, " is ", factor, "; expected a finite value above zero");
  }
}

template <typename Scalar>
void differencesOfBlocks(const CIEDE2000Factors& factors,
  const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& lab1,
  const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& lab2,
  Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>& difference) noexcept
{
  if (lab1.outerStride() == 3 && lab2.outerStride() == 3)
  {
    differencesCIEDE2000(factors, lab1.data(), lab2.data(), difference.data(),
      static_cast<std::size_t>(difference.size()));
    return;
  }
  for (Eigen::Index i = 0; i < difference.size(); ++i)
  {
    differencesCIEDE2000(factors, lab1.col(i).data(), lab2.col(i).data(), difference.data() + i, 1);
  }
}
}

CIEDE2000::CIEDE2000(const CIEDE2000Factors& factors)
  : Factors(factors)
{
  requirePositive(factors.kL, "kL");
  requirePositive(factors.kC, "kC");
  requirePositive(factors.kH, "kH");
}

double CIEDE2000::operator()(
  const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) const noexcept
{
  double difference = 0.0;
  differencesCIEDE2000(Factors, lab1.data(), lab2.data(), &difference, 1);
  return difference;
}

void CIEDE2000::apply(const Eigen::Ref<const Eigen::Matrix3Xd>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xd>& lab2,
  Eigen::Ref<Eigen::VectorXd> difference) const noexcept
{
  differencesOfBlocks<double>(Factors, lab1, lab2, difference);
}

void CIEDE2000::apply(const Eigen::Ref<const Eigen::Matrix3Xf>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xf>& lab2,
  Eigen::Ref<Eigen::VectorXf> difference) const noexcept
{
  differencesOfBlocks<float>(Factors, lab1, lab2, difference);
}

} // namespace msi

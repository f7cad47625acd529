#include "Kernels/Difference/MetamerismIndex.h"

#include "Kernels/Difference/CIE76.h"

#include <limits>

namespace msi
{

MetamerismIndex::MetamerismIndex(const WavelengthGrid& wavelengths, const Illuminant& reference,
  const Illuminant& test, const StandardObserver& observer)
  : Reference(wavelengths, reference, observer)
  , Test(wavelengths, test, observer)
  , Lab(Test.whitePoint())
{
}

void MetamerismIndex::apply(const Eigen::Ref<const Eigen::MatrixXd>& standard,
  // NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
  const Eigen::Ref<const Eigen::MatrixXd>& sample, Eigen::Ref<Eigen::VectorXd> index) const
{
  const Eigen::Index pairs = standard.cols();
  Eigen::Matrix3Xd first(3, pairs);
  Eigen::Matrix3Xd second(3, pairs);
  Reference.apply(standard, first);
  Reference.apply(sample, second);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Matrix3Xd ratio =
    (second.array() > 0.0).select(first.array() / second.array(), none);
  Test.apply(standard, first);
  Test.apply(sample, second);
  second.array() *= ratio.array();
  Lab.fromXYZ(first, first);
  Lab.fromXYZ(second, second);
  deltaE76(first, second, index);
}

} // namespace msi

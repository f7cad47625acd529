#include "Kernels/Estimation/ResponseColor.h"

#include "Kernels/Colorimetry/ColorBlocks.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>

namespace msi
{

namespace
{
TristimulusBlocks composed(
  const AffineTransform& toReflectance, const TristimulusTransform& tristimulus)
{
  const Eigen::Matrix3Xd& weights = tristimulus.weights();
  if (toReflectance.outputs() != weights.cols())
  {
    reject("the estimator gives ", toReflectance.outputs(),
      " bands; the tristimulus weights are for ", weights.cols());
  }
  return TristimulusBlocks(weights * toReflectance.linear(), weights * toReflectance.constant());
}
}

ResponseColor::ResponseColor(
  const AffineTransform& toReflectance, const TristimulusTransform& tristimulus)
  : ToXYZ(composed(toReflectance, tristimulus))
  , ToLab(tristimulus.whitePoint())
{
}

void ResponseColor::lab(const float* responses, float* lab, Eigen::Index pixels) const noexcept
{
  constexpr Eigen::Index Block = 1024; // XYZ stay in the cache
  for (Eigen::Index at = 0; at < pixels; at += Block)
  {
    const Eigen::Index count = std::min(Block, pixels - at);
    float* colors = lab + 3 * at;
    ToXYZ.apply(responses + ToXYZ.values() * at, colors, count);
    labFromXYZInFloat(ToLab.whitePoint().data(), colors, colors, static_cast<std::size_t>(count));
  }
}

} // namespace msi

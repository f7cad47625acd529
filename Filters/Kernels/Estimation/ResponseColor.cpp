#include "Kernels/Estimation/ResponseColor.h"

#include "Kernels/Colorimetry/ColorBlocks.h"
#include "Kernels/Difference/CIEDE2000Blocks.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <array>

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

void ResponseColor::differences(const CIEDE2000Factors& factors, const float* responses,
  const float* lab, float* difference, Eigen::Index pixels) const noexcept
{
  constexpr Eigen::Index Block = 128;
  alignas(64) std::array<float, 3 * Block> planes{};
  for (Eigen::Index at = 0; at < pixels; at += Block)
  {
    const Eigen::Index count = std::min(Block, pixels - at);
    ToXYZ.applyToPlanes(responses + ToXYZ.values() * at, planes.data(), Block, count);
    differencesFromXYZ(factors, ToLab.whitePoint().data(), lab + 3 * at, planes.data(), Block,
      difference + at, static_cast<std::size_t>(count));
  }
}

} // namespace msi

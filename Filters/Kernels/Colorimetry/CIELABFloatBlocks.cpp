#include "Kernels/Colorimetry/ColorBlocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Colorimetry/CIELABFloatBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Colorimetry/CIELABFloat-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

void labInFloat(const double* whitePoint, const float* xyz, float* lab, std::size_t count)
{
  const std::size_t lanes = hn::Lanes(FloatsTag());
  std::size_t first = 0;
  for (; first + lanes <= count; first += lanes)
  {
    storeFloatColors(labOf(whitePoint, loadFloatColors(xyz + 3 * first)), lab + 3 * first);
  }
  if (first < count)
  {
    std::array<float, 3 * MostFloats> group{};
    const std::size_t rest = 3 * (count - first);
    std::copy_n(xyz + 3 * first, rest, group.begin());
    storeFloatColors(labOf(whitePoint, loadFloatColors(group.data())), group.data());
    std::copy_n(group.begin(), rest, lab + 3 * first);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(labInFloat);

void labFromXYZInFloat(
  const double* whitePoint, const float* xyz, float* lab, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(labInFloat)(whitePoint, xyz, lab, count);
}

} // namespace msi
#endif

#include "Kernels/Colorimetry/ColorBlocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Colorimetry/CIELABBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Colorimetry/ColorVectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace
{
struct LabKernel
{
  Vector InverseX;
  Vector InverseY;
  Vector InverseZ;

  explicit LabKernel(const double* whitePoint)
    : InverseX(set(1.0 / whitePoint[0]))
    , InverseY(set(1.0 / whitePoint[1]))
    , InverseZ(set(1.0 / whitePoint[2]))
  {
  }

  static Vector compress(Vector ratio)
  {
    const Vector linear = hn::Add(hn::Mul(ratio, set(841.0 / 108.0)), set(4.0 / 29.0));
    const Mask bright = hn::Gt(ratio, set(216.0 / 24389.0));
    return hn::IfThenElse(bright, cubeRoot(ratio), linear);
  }

  Colors operator()(const Colors& xyz, std::size_t) const
  {
    const Vector x = compress(hn::Mul(xyz.first, InverseX));
    const Vector y = compress(hn::Mul(xyz.second, InverseY));
    const Vector z = compress(hn::Mul(xyz.third, InverseZ));
    return { hn::Sub(hn::Mul(set(116.0), y), set(16.0)), hn::Mul(set(500.0), hn::Sub(x, y)),
      hn::Mul(set(200.0), hn::Sub(y, z)) };
  }
};
}

void labFromXYZFloat(const double* whitePoint, const float* xyz, float* lab, std::size_t count)
{
  const LabKernel kernel(whitePoint);
  forEachGroup(xyz, lab, count, kernel);
}

void labFromXYZDouble(const double* whitePoint, const double* xyz, double* lab, std::size_t count)
{
  const LabKernel kernel(whitePoint);
  forEachGroup(xyz, lab, count, kernel);
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(labFromXYZFloat);
HWY_EXPORT(labFromXYZDouble);

template <>
void labFromXYZ<float>(
  const double* whitePoint, const float* xyz, float* lab, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(labFromXYZFloat)(whitePoint, xyz, lab, count);
}

template <>
void labFromXYZ<double>(
  const double* whitePoint, const double* xyz, double* lab, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(labFromXYZDouble)(whitePoint, xyz, lab, count);
}

} // namespace msi
#endif

#include "Kernels/Colorimetry/ColorBlocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Colorimetry/SRGBBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Colorimetry/ColorVectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace
{
struct SRGBKernel
{
  const double* Matrix;
  SRGBClipping Clipping;

  Vector channel(int row, const Colors& xyz) const
  {
    return hn::Add(
      hn::Add(hn::Mul(set(Matrix[row]), xyz.first), hn::Mul(set(Matrix[row + 3]), xyz.second)),
      hn::Mul(set(Matrix[row + 6]), xyz.third));
  }

  static Mask outOfGamut(Vector linear)
  {
    return hn::Or(
      hn::Lt(linear, set(-SRGBGamutTolerance)), hn::Gt(linear, set(1.0 + SRGBGamutTolerance)));
  }

  // x^(1/2.4) is the cube root times its own fourth root.
  static Vector encode(Vector linear)
  {
    const Vector clipped =
      hn::IfThenElse(hn::Gt(linear, set(1.0)), set(1.0), hn::ZeroIfNegative(linear));
    const Mask bright = hn::Gt(clipped, set(0.0031308));
    const Vector root = cubeRoot(hn::IfThenElse(bright, clipped, set(1.0)));
    const Vector power = hn::Mul(root, hn::Sqrt(hn::Sqrt(root)));
    return hn::IfThenElse(
      bright, hn::Sub(hn::Mul(set(1.055), power), set(0.055)), hn::Mul(set(12.92), clipped));
  }

  Colors operator()(const Colors& xyz, std::size_t used)
  {
    const Colors linear{ channel(0, xyz), channel(1, xyz), channel(2, xyz) };
    // Zero where all three are finite, NaN elsewhere.
    const Vector fault =
      hn::Mul(hn::Add(hn::Add(hn::Mul(linear.first, set(0.0)), hn::Mul(linear.second, set(0.0))),
                hn::Mul(linear.third, set(0.0))),
        set(0.0));
    const Mask valid = hn::FirstN(Doubles(), used);
    const Mask notFinite = hn::And(valid, hn::IsNaN(fault));
    const Mask outside =
      hn::Or(hn::Or(outOfGamut(linear.first), outOfGamut(linear.second)), outOfGamut(linear.third));
    Clipping.notFinite += static_cast<std::int64_t>(hn::CountTrue(Doubles(), notFinite));
    Clipping.outOfGamut += static_cast<std::int64_t>(
      hn::CountTrue(Doubles(), hn::AndNot(notFinite, hn::And(valid, outside))));
    return { hn::Add(encode(linear.first), fault), hn::Add(encode(linear.second), fault),
      hn::Add(encode(linear.third), fault) };
  }
};
}

SRGBClipping sRGBFromXYZFloat(
  const double* linearMatrix, const float* xyz, float* rgb, std::size_t count)
{
  SRGBKernel kernel{ linearMatrix, {} };
  forEachGroup(xyz, rgb, count, kernel);
  return kernel.Clipping;
}

SRGBClipping sRGBFromXYZDouble(
  const double* linearMatrix, const double* xyz, double* rgb, std::size_t count)
{
  SRGBKernel kernel{ linearMatrix, {} };
  forEachGroup(xyz, rgb, count, kernel);
  return kernel.Clipping;
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(sRGBFromXYZFloat);
HWY_EXPORT(sRGBFromXYZDouble);

template <>
SRGBClipping sRGBFromXYZ<float>(
  const double* linearMatrix, const float* xyz, float* rgb, std::size_t count) noexcept
{
  return HWY_DYNAMIC_DISPATCH(sRGBFromXYZFloat)(linearMatrix, xyz, rgb, count);
}

template <>
SRGBClipping sRGBFromXYZ<double>(
  const double* linearMatrix, const double* xyz, double* rgb, std::size_t count) noexcept
{
  return HWY_DYNAMIC_DISPATCH(sRGBFromXYZDouble)(linearMatrix, xyz, rgb, count);
}

} // namespace msi
#endif

#include "Kernels/Colorimetry/ColorBlocks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Colorimetry/CIELABFloatBlocks.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace
{
namespace hn = hwy::HWY_NAMESPACE;

// CIELAB without a step in double: twice as many colors a vector. Mul and Add, never MulAdd: every instruction set rounds
// the same way.
using LabTag = hn::ScalableTag<float>;
using LabVector = hn::Vec<LabTag>;
constexpr std::size_t MostColors = hn::MaxLanes(LabTag());

LabVector labConstant(double value)
{
  return hn::Set(LabTag(), static_cast<float>(value));
}

// The cube root of x within 1e-30..1e30 to 1e-7; of anything else, anything. The inverse cube root from the exponent, off
// by 3.5 %, by four terms of its series to 1.7e-5; then a step of Newton's method for the root itself.
LabVector cubeRootOf(LabVector x)
{
  const LabTag d;
  const hn::RebindToSigned<LabTag> integers;
  const LabVector third = labConstant(1.0 / 3.0);
  const auto exponent = hn::ConvertTo(d, hn::BitCast(integers, x));
  const auto bits = hn::Sub(labConstant(1419909090.0), hn::Mul(exponent, third));
  const LabVector guess = hn::BitCast(d, hn::ConvertTo(integers, bits));
  const LabVector remainder =
    hn::Sub(labConstant(1.0), hn::Mul(x, hn::Mul(guess, hn::Mul(guess, guess))));
  LabVector series = hn::Mul(labConstant(14.0 / 81.0), remainder);
  series = hn::Mul(hn::Add(series, labConstant(2.0 / 9.0)), remainder);
  series = hn::Mul(hn::Add(series, third), remainder);
  const LabVector inverse = hn::Add(guess, hn::Mul(guess, series));
  const LabVector square = hn::Mul(inverse, inverse);
  const LabVector root = hn::Mul(x, square);
  const LabVector excess = hn::Sub(hn::Mul(hn::Mul(root, root), root), x);
  return hn::Sub(root, hn::Mul(excess, hn::Mul(square, third)));
}

LabVector compressed(LabVector ratio)
{
  const LabVector linear =
    hn::Add(hn::Mul(ratio, labConstant(841.0 / 108.0)), labConstant(4.0 / 29.0));
  return hn::IfThenElse(hn::Gt(ratio, labConstant(216.0 / 24389.0)), cubeRootOf(ratio), linear);
}

void labOfGroup(const double* whitePoint, const float* xyz, float* lab)
{
  const LabTag d;
  LabVector x;
  LabVector y;
  LabVector z;
  hn::LoadInterleaved3(d, xyz, x, y, z);
  x = compressed(hn::Mul(x, labConstant(1.0 / whitePoint[0])));
  y = compressed(hn::Mul(y, labConstant(1.0 / whitePoint[1])));
  z = compressed(hn::Mul(z, labConstant(1.0 / whitePoint[2])));
  hn::StoreInterleaved3(hn::Sub(hn::Mul(labConstant(116.0), y), labConstant(16.0)),
    hn::Mul(labConstant(500.0), hn::Sub(x, y)), hn::Mul(labConstant(200.0), hn::Sub(y, z)), d, lab);
}
}

void labInFloat(const double* whitePoint, const float* xyz, float* lab, std::size_t count)
{
  const std::size_t lanes = hn::Lanes(LabTag());
  std::size_t first = 0;
  for (; first + lanes <= count; first += lanes)
  {
    labOfGroup(whitePoint, xyz + 3 * first, lab + 3 * first);
  }
  if (first < count)
  {
    std::array<float, 3 * MostColors> group{};
    const std::size_t rest = 3 * (count - first);
    std::copy_n(xyz + 3 * first, rest, group.begin());
    labOfGroup(whitePoint, group.data(), group.data());
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

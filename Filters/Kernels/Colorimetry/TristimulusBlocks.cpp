#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Colorimetry/TristimulusBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Colorimetry/TristimulusBlocks.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace
{
namespace hn = hwy::HWY_NAMESPACE;

constexpr Eigen::Index Together = 4;    // values of a group, and pixels side by side
constexpr Eigen::Index GroupsAFold = 8; // the groups that are summed before the total

#if HWY_TARGET ==                                                                                  \
  HWY_SCALAR // where Highway has no vectors of four (GCC before 12.3): the same sums in the same order
void fourPixels(const float* weights, const float* constant, Eigen::Index groups,
  const float* values, Eigen::Index stride, Eigen::Index lastGroup, float* xyz)
{
  using Sums = Eigen::Array4f;
  for (Eigen::Index plane = 0; plane < 3; ++plane)
  {
    for (Eigen::Index pixel = 0; pixel < Together; ++pixel)
    {
      Sums total = Sums::Zero();
      for (Eigen::Index begin = 0; begin < groups; begin += GroupsAFold)
      {
        Sums fold = Sums::Zero();
        for (Eigen::Index g = begin; g < std::min(begin + GroupsAFold, groups); ++g)
        {
          const float* at = values + (g + 1 < groups ? Together * g : lastGroup);
          fold += Sums::Map(weights + 16 * g + Together * plane) * Sums::Map(at + pixel * stride);
        }
        total += fold;
      }
      xyz[3 * pixel + plane] =
        ((total[0] + total[2]) + (total[1] + total[3])) + constant[Together * plane + pixel];
    }
  }
}
#else
using Tag = hn::CappedTag<float, 16>;
using Sums = hn::Vec<Tag>;
using Four = hn::FixedTag<float, 4>;
static_assert(hn::MaxLanes(Tag()) >= 4, "XYZ are summed four values at a time");

// [a0 + a2, b0 + b2, a1 + a3, b1 + b3] of each four.
Sums addHalves(Sums a, Sums b)
{
  return hn::Add(hn::InterleaveLower(Tag(), a, b), hn::InterleaveUpper(Tag(), a, b));
}

struct PixelSums
{
  Sums first, second, third, fourth;
};

PixelSums add(const PixelSums& a, const PixelSums& b)
{
  return { hn::Add(a.first, b.first), hn::Add(a.second, b.second), hn::Add(a.third, b.third),
    hn::Add(a.fourth, b.fourth) };
}

// Four pixels that are 'stride' values apart, 'groups' of four values each.
void fourPixels(const float* weights, const float* constant, Eigen::Index groups,
  const float* values, Eigen::Index stride, Eigen::Index lastGroup, float* xyz)
{
  const Tag d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  HWY_ALIGN std::array<float, 16> planes;
  // The fourth row of four is zeros: no need to sum it where it is a vector of its own.
  for (Eigen::Index part = 0; part < 12; part += lanes)
  {
    const Sums zero = hn::Zero(d);
    PixelSums total{ zero, zero, zero, zero };
    for (Eigen::Index begin = 0; begin < groups; begin += GroupsAFold)
    {
      PixelSums fold{ zero, zero, zero, zero };
      for (Eigen::Index g = begin; g < std::min(begin + GroupsAFold, groups); ++g)
      {
        const Sums weight = hn::LoadU(d, weights + 16 * g + part);
        const float* at = values + (g + 1 < groups ? Together * g : lastGroup);
        const auto weighed = [&](Eigen::Index pixel) HWY_ATTR
        { return hn::Mul(weight, hn::LoadDup128(d, at + pixel * stride)); };
        fold = add(fold, { weighed(0), weighed(1), weighed(2), weighed(3) });
      }
      total = add(total, fold);
    }
    // In every four lanes: the sums of four pixels.
    const Sums left = addHalves(total.first, total.third);
    const Sums right = addHalves(total.second, total.fourth);
    const Sums sums = addHalves(left, right);
    hn::StoreU(hn::Add(sums, hn::LoadU(d, constant + part)), d, planes.data() + part);
  }
  const Four four;
  hn::StoreInterleaved3(hn::Load(four, planes.data()), hn::Load(four, planes.data() + 4),
    hn::Load(four, planes.data() + 8), four, xyz);
}
#endif
}

void runTristimulus(const float* weights, const float* constant, Eigen::Index count,
  const float* values, float* xyz, Eigen::Index pixels)
{
  const Eigen::Index groups = (count + Together - 1) / Together;
  const Eigen::Index lastGroup = std::max<Eigen::Index>(count - Together, 0);
  Eigen::Index first = 0;
  for (; count >= Together && first + Together <= pixels; first += Together)
  {
    fourPixels(
      weights, constant, groups, values + first * count, count, lastGroup, xyz + 3 * first);
  }
  // What is left, pixel by pixel; of fewer than four values from a copy that has four.
  for (; first < pixels; ++first)
  {
    std::array<float, Together> padded{};
    std::array<float, 3 * Together> result;
    const float* pixel = values + first * count;
    if (count < Together)
    {
      std::copy_n(pixel, count, padded.begin());
      pixel = padded.data();
    }
    fourPixels(weights, constant, groups, pixel, 0, lastGroup, result.data());
    std::copy_n(result.begin(), 3, xyz + 3 * first);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(runTristimulus);

TristimulusBlocks::TristimulusBlocks(
  const Eigen::Matrix3Xd& weights, const Eigen::Vector3d& constant)
  : Values(weights.cols())
{
  for (Eigen::Index summed = 0; summed < Values; summed += 4)
  {
    const Eigen::Index first = std::max<Eigen::Index>(std::min(summed, Values - 4), 0);
    for (Eigen::Index row = 0; row < 4; ++row)
    {
      for (Eigen::Index i = first; i < first + 4; ++i)
      {
        const bool counts = row < 3 && i >= summed && i < Values;
        Weights.push_back(counts ? static_cast<float>(weights(row, i)) : 0.0F);
      }
    }
  }
  for (Eigen::Index i = 0; i < 12; ++i)
  {
    Constant[static_cast<std::size_t>(i)] = static_cast<float>(constant[i / 4]);
  }
}

void TristimulusBlocks::apply(const float* values, float* xyz, Eigen::Index pixels) const noexcept
{
  HWY_DYNAMIC_DISPATCH(runTristimulus)
  (Weights.data(), Constant.data(), Values, values, xyz, pixels);
}

} // namespace msi
#endif

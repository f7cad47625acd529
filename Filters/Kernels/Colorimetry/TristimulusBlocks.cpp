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
template <Eigen::Index Pixels>
void somePixels(const float* weights, const float* constant, Eigen::Index groups,
  const float* values, Eigen::Index stride, Eigen::Index lastGroup, float* planes)
{
  using Sums = Eigen::Array4f;
  for (Eigen::Index plane = 0; plane < 3; ++plane)
  {
    for (Eigen::Index pixel = 0; pixel < Pixels; ++pixel)
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
      planes[pixel / Together * 16 + Together * plane + pixel % Together] =
        ((total[0] + total[2]) + (total[1] + total[3])) + constant[Together * plane];
    }
  }
}

void interleave(const float* planes, float* xyz)
{
  for (Eigen::Index i = 0; i < 3 * Together; ++i)
  {
    xyz[i] = planes[Together * (i % 3) + i / 3];
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

// Adds weight times four values of each pixel.
template <Eigen::Index Pixels>
HWY_INLINE void addGroup(Sums* sums, const float* weights, const float* at, Eigen::Index stride)
{
  const Tag d;
  const Sums weight = hn::LoadU(d, weights);
  for (Eigen::Index pixel = 0; pixel < Pixels; ++pixel)
  {
    const Sums weighed = hn::Mul(weight, hn::LoadDup128(d, at + pixel * stride));
    sums[pixel] = hn::Add(sums[pixel], weighed);
  }
}

// Pixels that are 'stride' values apart, 'groups' of four values each. Of each four of them: their X, their Y, their Z, in
// planes of 16 floats.
template <Eigen::Index Pixels>
HWY_INLINE void somePixels(const float* weights, const float* constant, Eigen::Index groups,
  const float* values, Eigen::Index stride, Eigen::Index lastGroup, float* planes)
{
  const Tag d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  // The fourth row of four is zeros: no need to sum it where it is a vector of its own.
  for (Eigen::Index part = 0; part < 12; part += lanes)
  {
    Sums total[Pixels];
    std::fill_n(total, Pixels, hn::Zero(d));
    Eigen::Index group = 0;
    const auto addFold = [&](Sums* sums) HWY_ATTR
    {
      const Eigen::Index end = std::min(group + GroupsAFold, groups);
      const Eigen::Index wholeEnd = std::min(end, groups - 1);
      for (; group < wholeEnd; ++group)
      {
        addGroup<Pixels>(sums, weights + 16 * group + part, values + Together * group, stride);
      }
      if (group < end)
      {
        addGroup<Pixels>(sums, weights + 16 * group + part, values + lastGroup, stride);
        ++group;
      }
    };
    addFold(total);
    while (group < groups)
    {
      Sums fold[Pixels];
      std::fill_n(fold, Pixels, hn::Zero(d));
      addFold(fold);
      for (Eigen::Index pixel = 0; pixel < Pixels; ++pixel)
      {
        total[pixel] = hn::Add(total[pixel], fold[pixel]);
      }
    }
    // In every four lanes: the sums of four pixels.
    const Sums start = hn::LoadU(d, constant + part);
    for (Eigen::Index four = 0; four < Pixels; four += Together)
    {
      const Sums left = addHalves(total[four], total[four + 2]);
      const Sums right = addHalves(total[four + 1], total[four + 3]);
      hn::StoreU(hn::Add(addHalves(left, right), start), d, planes + 4 * four + part);
    }
  }
}

HWY_INLINE void interleave(const float* planes, float* xyz)
{
  const Four four;
  hn::StoreInterleaved3(hn::Load(four, planes), hn::Load(four, planes + Together),
    hn::Load(four, planes + 2 * Together), four, xyz);
}
#endif

void storeFour(const float* planes, float* xyz, Eigen::Index planeStride, Eigen::Index pixelStride)
{
  if (pixelStride != 1)
  {
    interleave(planes, xyz);
    return;
  }
  for (Eigen::Index plane = 0; plane < 3; ++plane)
  {
    std::copy_n(planes + Together * plane, Together, xyz + plane * planeStride);
  }
}
}

void runTristimulus(const float* weights, const float* constant, Eigen::Index count,
  const float* values, float* xyz, Eigen::Index planeStride, Eigen::Index pixelStride,
  Eigen::Index pixels)
{
  const Eigen::Index groups = (count + Together - 1) / Together;
  const Eigen::Index lastGroup = std::max<Eigen::Index>(count - Together, 0);
  constexpr Eigen::Index AtOnce = 2 * Together;
  HWY_ALIGN std::array<float, 4 * AtOnce> planes;
  Eigen::Index first = 0;
  for (; count >= Together && first + AtOnce <= pixels; first += AtOnce)
  {
    somePixels<AtOnce>(
      weights, constant, groups, values + first * count, count, lastGroup, planes.data());
    for (Eigen::Index four = 0; four < AtOnce; four += Together)
    {
      storeFour(
        planes.data() + 4 * four, xyz + (first + four) * pixelStride, planeStride, pixelStride);
    }
  }
  // What is left, pixel by pixel; of fewer than four values from a copy that has four.
  for (; first < pixels; ++first)
  {
    std::array<float, Together> padded{};
    const float* pixel = values + first * count;
    if (count < Together)
    {
      std::copy_n(pixel, count, padded.begin());
      pixel = padded.data();
    }
    somePixels<Together>(weights, constant, groups, pixel, 0, lastGroup, planes.data());
    for (Eigen::Index plane = 0; plane < 3; ++plane)
    {
      xyz[plane * planeStride + first * pixelStride] =
        planes[static_cast<std::size_t>(Together * plane)];
    }
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
  (Weights.data(), Constant.data(), Values, values, xyz, 1, 3, pixels);
}

void TristimulusBlocks::applyToPlanes(
  const float* values, float* xyz, Eigen::Index planeStride, Eigen::Index pixels) const noexcept
{
  HWY_DYNAMIC_DISPATCH(runTristimulus)
  (Weights.data(), Constant.data(), Values, values, xyz, planeStride, 1, pixels);
}

} // namespace msi
#endif

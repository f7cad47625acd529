#include "Kernels/Colorimetry/ColorBlocks.h"
#include "Kernels/Difference/CIEDE2000Blocks.h"

#include <algorithm>
#include <array>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Difference/CIEDE2000FloatBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Colorimetry/CIELABFloat-inl.h"
#include "Kernels/Difference/CIEDE2000Float-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace
{
// The second colors: vectors of them, and one coordinate of one.
struct Interleaved
{
  const float* lab;
  FloatColors operator()(std::size_t at) const { return loadFloatColors(lab + 3 * at); }
  double coordinate(std::size_t at, std::size_t which) const { return lab[3 * at + which]; }
};

using Planes = std::array<float, 3 * BlockOfPairs>;

FloatColors loadPlanes(const float* plane, std::size_t stride)
{
  const FloatsTag d;
  return { hn::LoadU(d, plane), hn::LoadU(d, plane + stride), hn::LoadU(d, plane + 2 * stride) };
}

struct InPlanes
{
  const Planes* lab;
  FloatColors operator()(std::size_t at) const
  {
    return loadPlanes(lab->data() + at, BlockOfPairs);
  }
  double coordinate(std::size_t at, std::size_t which) const
  {
    return (*lab)[which * BlockOfPairs + at];
  }
};

// 'count' is a multiple of the lanes, at most BlockOfPairs.
template <typename Colors>
void oneBlock(const CIEDE2000Factors& factors, const FloatFactors& inFloat, const float* lab1,
  const Colors& lab2, float* result, std::size_t count)
{
  const FloatsTag d;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN PairBlock block;
  for (std::size_t i = 0; i < count; i += lanes)
  {
    stretchPairs(inFloat, loadFloatColors(lab1 + 3 * i), lab2(i), block, i);
  }
  for (std::size_t i = 0; i < count; i += lanes)
  {
    turnPairs(inFloat, block, i);
  }
  FloatsVector uncertain = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += lanes)
  {
    hn::StoreU(sumOfPairs(block, i), d, result + i);
    uncertain = hn::Max(hn::LoadU(d, &block.uncertain[i]), uncertain);
  }
  if (hn::AllFalse(d, hn::Gt(uncertain, hn::Set(d, LargestSquare))))
  {
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (block.uncertain[i] > LargestSquare)
    {
      std::array<double, 3> first{};
      std::array<double, 3> second{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        first[k] = lab1[3 * i + k];
        second[k] = lab2.coordinate(i, k);
      }
      double difference = 0.0;
      differencesCIEDE2000<double>(factors, first.data(), second.data(), &difference, 1);
      result[i] = static_cast<float>(difference);
    }
  }
}
}

void differencesInFloat(const CIEDE2000Factors& factors, const float* lab1, const float* lab2,
  float* result, std::size_t count)
{
  const FloatFactors inFloat(factors);
  const std::size_t whole = count - count % hn::Lanes(FloatsTag());
  for (std::size_t at = 0; at < whole; at += BlockOfPairs)
  {
    oneBlock(factors, inFloat, lab1 + 3 * at, Interleaved{ lab2 + 3 * at }, result + at,
      std::min(BlockOfPairs, whole - at));
  }
  if (whole < count)
  {
    const std::size_t rest = count - whole;
    std::array<float, 3 * MostFloats> group1{};
    std::array<float, 3 * MostFloats> group2{};
    std::array<float, MostFloats> group{};
    std::copy_n(lab1 + 3 * whole, 3 * rest, group1.begin());
    std::copy_n(lab2 + 3 * whole, 3 * rest, group2.begin());
    oneBlock(factors, inFloat, group1.data(), Interleaved{ group2.data() }, group.data(),
      hn::Lanes(FloatsTag()));
    std::copy_n(group.begin(), rest, result + whole);
  }
}

void differencesOfXYZInFloat(const CIEDE2000Factors& factors, const double* whitePoint,
  const float* lab, const float* xyz, std::size_t planeStride, float* result, std::size_t count)
{
  const FloatsTag d;
  const FloatFactors inFloat(factors);
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN Planes planes;
  for (std::size_t at = 0; at < count; at += BlockOfPairs)
  {
    const std::size_t block = std::min(BlockOfPairs, count - at);
    for (std::size_t i = 0; i < block; i += lanes)
    {
      const FloatColors color = labOf(whitePoint, loadPlanes(xyz + at + i, planeStride));
      hn::StoreU(color.first, d, &planes[i]);
      hn::StoreU(color.second, d, &planes[BlockOfPairs + i]);
      hn::StoreU(color.third, d, &planes[2 * BlockOfPairs + i]);
    }
    if (block == BlockOfPairs)
    {
      oneBlock(factors, inFloat, lab + 3 * at, InPlanes{ &planes }, result + at, block);
      continue;
    }
    std::array<float, 3 * BlockOfPairs> padded{};
    std::array<float, BlockOfPairs> differences{};
    std::copy_n(lab + 3 * at, 3 * block, padded.begin());
    oneBlock(factors, inFloat, padded.data(), InPlanes{ &planes }, differences.data(),
      (block + lanes - 1) / lanes * lanes);
    std::copy_n(differences.begin(), block, result + at);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(differencesInFloat);
HWY_EXPORT(differencesOfXYZInFloat);

void differencesFromXYZ(const CIEDE2000Factors& factors, const double* whitePoint, const float* lab,
  const float* xyz, std::size_t planeStride, float* difference, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(differencesOfXYZInFloat)
  (factors, whitePoint, lab, xyz, planeStride, difference, count);
}

template <>
void differencesCIEDE2000<float>(const CIEDE2000Factors& factors, const float* lab1,
  const float* lab2, float* difference, std::size_t count) noexcept
{
  HWY_DYNAMIC_DISPATCH(differencesInFloat)(factors, lab1, lab2, difference, count);
}

} // namespace msi
#endif

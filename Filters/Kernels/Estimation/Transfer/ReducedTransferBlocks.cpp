#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Estimation/Transfer/ReducedTransferBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Estimation/Transfer/ReducedTransfer.h"
#include "Kernels/Spectra/FusedMultiply-inl.h"

#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// A lane is a pixel; two vectors of pixels side by side, so that a coefficient is read once for both.
using FloatTag = hn::CappedTag<float, 16>;
using FloatVector = hn::Vec<FloatTag>;

// 2^x for x <= 0.5 to 1.5e-7 of its value, held at 2^-64, where no product is denormal: minimax polynomial on [-1/2, 1/2].
HWY_INLINE FloatVector powerOfTwo(FloatTag d, FloatVector x)
{
  const auto magic = hn::Set(d, 12582912.0F); // 1.5 * 2^23: leaves the integer in the low bits
  x = hn::Max(x, hn::Set(d, -64.0F));
  const auto shifted = hn::Add(x, magic);
  const auto r = hn::Sub(x, hn::Sub(shifted, magic));
  auto sum = hn::Set(d, 0.0013276472F);
  for (const float next : { 0.0096755413F, 0.055507133F, 0.24022120F, 0.69314697F, 1.00000007F })
  {
    sum = fusedMultiplyAdd(d, sum, r, hn::Set(d, next));
  }
  const hn::Rebind<std::int32_t, FloatTag> integers;
  return hn::BitCast(
    d, hn::Add(hn::BitCast(integers, sum), hn::ShiftLeft<23>(hn::BitCast(integers, shifted))));
}

// out[row] = end(start[row] + sum over the columns, its vector).
template <class End>
HWY_INLINE void product(
  FloatTag d, const GroupedMatrix& matrix, const float* in, float* out, const End& end)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const float* a = matrix.values.data();
  for (Eigen::Index row = 0; row < matrix.rows; row += 4, out += 8 * lanes)
  {
    auto s00 = hn::Set(d, a[0]);
    auto s10 = hn::Set(d, a[1]);
    auto s20 = hn::Set(d, a[2]);
    auto s30 = hn::Set(d, a[3]);
    auto s01 = s00;
    auto s11 = s10;
    auto s21 = s20;
    auto s31 = s30;
    a += 4;
    const float* x = in;
    for (Eigen::Index column = 0; column < matrix.columns; ++column, a += 4, x += 2 * lanes)
    {
      const auto x0 = hn::LoadU(d, x);
      const auto x1 = hn::LoadU(d, x + lanes);
      const auto a0 = hn::Set(d, a[0]);
      s00 = fusedMultiplyAdd(d, a0, x0, s00);
      s01 = fusedMultiplyAdd(d, a0, x1, s01);
      const auto a1 = hn::Set(d, a[1]);
      s10 = fusedMultiplyAdd(d, a1, x0, s10);
      s11 = fusedMultiplyAdd(d, a1, x1, s11);
      const auto a2 = hn::Set(d, a[2]);
      s20 = fusedMultiplyAdd(d, a2, x0, s20);
      s21 = fusedMultiplyAdd(d, a2, x1, s21);
      const auto a3 = hn::Set(d, a[3]);
      s30 = fusedMultiplyAdd(d, a3, x0, s30);
      s31 = fusedMultiplyAdd(d, a3, x1, s31);
    }
    hn::StoreU(end(s00, 0, out), d, out);
    hn::StoreU(end(s01, 1, out + lanes), d, out + lanes);
    hn::StoreU(end(s10, 0, out + 2 * lanes), d, out + 2 * lanes);
    hn::StoreU(end(s11, 1, out + 3 * lanes), d, out + 3 * lanes);
    hn::StoreU(end(s20, 0, out + 4 * lanes), d, out + 4 * lanes);
    hn::StoreU(end(s21, 1, out + 5 * lanes), d, out + 5 * lanes);
    hn::StoreU(end(s30, 0, out + 6 * lanes), d, out + 6 * lanes);
    hn::StoreU(end(s31, 1, out + 7 * lanes), d, out + 7 * lanes);
  }
}

struct ReducedScratch
{
  float* response;
  float* features;
  float* projected;
  float* gaussians;
  float* components;
  float* mean;
};

// Channels of pixels as rows of pixels; the last pixel fills up. 'fours' has room for as much: vectors are loaded long
// after the pieces they consist of were stored, else each load would wait for the stores.
HWY_INLINE void loadPixels(FloatTag d, const float* pixels, Eigen::Index count,
  Eigen::Index channels, float* fours, float* rows)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  for (Eigen::Index pixel = 0; pixel < 2 * lanes; ++pixel)
  {
    const float* from = pixels + std::min(pixel, count - 1) * channels;
    float* to = fours + 4 * pixel;
    Eigen::Index first = 0;
    for (; first + 4 <= channels; first += 4, to += 8 * lanes)
    {
      std::memcpy(to, from + first, 4 * sizeof(float));
    }
    if (first < channels)
    {
      std::fill(std::copy(from + first, from + channels, to), to + 4, 0.0F);
    }
  }
  // Rows are padded to a multiple of four.
  for (Eigen::Index first = 0; first < channels; first += 4, rows += 8 * lanes)
  {
    for (Eigen::Index half = 0; half < 2; ++half, fours += 4 * lanes)
    {
      FloatVector v0;
      FloatVector v1;
      FloatVector v2;
      FloatVector v3;
      hn::LoadInterleaved4(d, fours, v0, v1, v2, v3);
      float* row = rows + half * lanes;
      hn::Store(v0, d, row);
      hn::Store(v1, d, row + 2 * lanes);
      hn::Store(v2, d, row + 4 * lanes);
      hn::Store(v3, d, row + 6 * lanes);
    }
  }
}

// The other way round. The last bands are written first: what they write too much of, the pixel
// behind them overwrites.
HWY_INLINE void storePixels(
  FloatTag d, const float* rows, Eigen::Index count, Eigen::Index bands, float* pixels)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  HWY_ALIGN float four[4 * 16];
  for (Eigen::Index first = (bands - 1) / 4 * 4; first >= 0; first -= 4)
  {
    for (Eigen::Index half = 0; half < 2; ++half)
    {
      const float* row = rows + (2 * first + half) * lanes;
      hn::StoreInterleaved4(hn::LoadU(d, row), hn::LoadU(d, row + 2 * lanes),
        hn::LoadU(d, row + 4 * lanes), hn::LoadU(d, row + 6 * lanes), d, four);
      const Eigen::Index last = std::min(lanes, count - half * lanes);
      for (Eigen::Index lane = 0; lane < last; ++lane)
      {
        const Eigen::Index pixel = half * lanes + lane;
        float* to = pixels + pixel * bands + first;
        if (first + 4 <= bands || pixel + 1 < count)
        {
          std::memcpy(to, four + 4 * lane, 4 * sizeof(float));
        }
        else
        {
          std::copy_n(four + 4 * lane, bands - first, to);
        }
      }
    }
  }
}

// Adds one expert's share to the mean of two vectors of pixels.
HWY_INLINE void addReducedExpert(FloatTag d, const ReducedTransferExpert& e, Eigen::Index channels,
  const ReducedScratch& s, bool isFirst)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  auto norm0 = hn::Zero(d);
  auto norm1 = norm0;
  auto poison0 = norm0;
  auto poison1 = norm0;
  const bool isRoot = e.space == TransferSpace::SquareRoot;
  for (Eigen::Index c = 0; c < channels; ++c)
  {
    const auto i = static_cast<std::size_t>(c);
    const auto feature = [&](Eigen::Index half, FloatVector& norm, FloatVector& poison) HWY_ATTR
    {
      const auto v = hn::LoadU(d, s.response + (2 * c + half) * lanes);
      auto z = hn::Add(hn::Mul(hn::Set(d, e.gain[i]), v), hn::Set(d, e.offset[i]));
      if (isRoot)
      {
        z = hn::CopySign(hn::Sqrt(hn::Abs(z)), z);
      }
      const auto f = hn::Sub(hn::Mul(z, hn::Set(d, e.scale[i])), hn::Set(d, e.center[i]));
      hn::StoreU(f, d, s.features + (2 * c + half) * lanes);
      norm = hn::Add(norm, hn::Mul(f, f));
      poison = hn::Add(poison, hn::Mul(v, hn::Zero(d)));
    };
    feature(0, norm0, poison0);
    feature(1, norm1, poison1);
  }
  norm0 = hn::Mul(norm0, hn::Set(d, e.decay));
  norm1 = hn::Mul(norm1, hn::Set(d, e.decay));
  const auto asIs = [](FloatVector sum, int, const float*) HWY_ATTR { return sum; };
  product(d, e.projection, s.features, s.projected, asIs);
  product(d, e.points, s.projected, s.gaussians,
    [&](FloatVector sum, int half, const float*) HWY_ATTR
    { return powerOfTwo(d, hn::Add(sum, half == 0 ? norm0 : norm1)); });
  const auto addToMean = [&](FloatVector y, int half, const float* mean) HWY_ATTR
  {
    y = hn::Add(isRoot ? hn::Mul(y, hn::Abs(y)) : y, half == 0 ? poison0 : poison1);
    return isFirst ? y : hn::Add(hn::LoadU(d, mean), y);
  };
  product(d, e.direct, s.features, s.components, asIs);
  product(d, e.smooth, s.gaussians, s.components,
    [&](FloatVector sum, int, const float* at) HWY_ATTR { return hn::Add(sum, hn::LoadU(d, at)); });
  if (e.expansion.rows > 0)
  {
    product(d, e.expansion, s.components, s.mean, addToMean);
    return;
  }
  for (Eigen::Index row = 0; row < 2 * e.smooth.rows; ++row)
  {
    float* mean = s.mean + row * lanes;
    const auto y = hn::LoadU(d, s.components + row * lanes);
    hn::StoreU(addToMean(y, static_cast<int>(row % 2), mean), d, mean);
  }
}

void runReducedBlock(
  const ReducedTransfer& mixture, const float* response, float* mean, Eigen::Index pixels)
{
  const FloatTag d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const auto fourfold = [](Eigen::Index count) { return (count + 3) / 4 * 4; };
  Eigen::Index directions = 0;
  Eigen::Index points = 0;
  Eigen::Index components = 0;
  for (const ReducedTransferExpert& expert : mixture.experts)
  {
    directions = std::max(directions, expert.projection.rows);
    points = std::max(points, expert.points.rows);
    components = std::max(components, expert.direct.rows);
  }
  const Eigen::Index channels = fourfold(mixture.channels);
  const Eigen::Index width = 2 * lanes;
  const auto memory = hwy::AllocateAligned<float>(static_cast<std::size_t>(
    width * (2 * channels + directions + points + components + fourfold(mixture.bands))));
  ReducedScratch s{};
  s.response = memory.get();
  s.features = s.response + width * channels;
  s.projected = s.features + width * channels;
  s.gaussians = s.projected + width * directions;
  s.components = s.gaussians + width * points;
  s.mean = s.components + width * components;
  for (Eigen::Index first = 0; first < pixels; first += width)
  {
    const Eigen::Index count = std::min(width, pixels - first);
    loadPixels(
      d, response + first * mixture.channels, count, mixture.channels, s.features, s.response);
    bool isFirst = true;
    for (const ReducedTransferExpert& expert : mixture.experts)
    {
      addReducedExpert(d, expert, mixture.channels, s, isFirst);
      isFirst = false;
    }
    storePixels(d, s.mean, count, mixture.bands, mean + first * mixture.bands);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(runReducedBlock);

void runReducedTransfer(
  const ReducedTransfer& mixture, const float* response, float* mean, Eigen::Index pixels) noexcept
{
  HWY_DYNAMIC_DISPATCH(runReducedBlock)(mixture, response, mean, pixels);
}

} // namespace msi
#endif

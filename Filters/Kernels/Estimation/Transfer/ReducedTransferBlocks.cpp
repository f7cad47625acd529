#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Estimation/Transfer/ReducedTransferBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Estimation/Transfer/ReducedTransfer.h"
#include "Kernels/Spectra/FloatVectors-inl.h"

#include <hwy/aligned_allocator.h>
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// A lane is a pixel; several vectors of pixels side by side, so that a coefficient is read once for all of them. As many as
// there are registers for.
constexpr Eigen::Index Side = MostFloats == 16 ? 4 : 2;

// 2^x for x <= 0.5 to 1.5e-7 of its value, held at 2^-64, where no product is denormal: minimax polynomial on [-1/2, 1/2].
HWY_INLINE FloatsVector powerOfTwo(FloatsTag d, FloatsVector x)
{
  const auto magic = hn::Set(d, 12582912.0F); // 1.5 * 2^23: leaves the integer in the low bits
  x = hn::Max(x, hn::Set(d, -64.0F));
  const auto shifted = hn::Add(x, magic);
  const auto r = hn::Sub(x, hn::Sub(shifted, magic));
  auto sum = hn::Set(d, 0.0013276472F);
  for (const float next : { 0.0096755413F, 0.055507133F, 0.24022120F, 0.69314697F, 1.00000007F })
  {
    sum = fused(sum, r, hn::Set(d, next));
  }
  const hn::Rebind<std::int32_t, FloatsTag> integers;
  return hn::BitCast(
    d, hn::Add(hn::BitCast(integers, sum), hn::ShiftLeft<23>(hn::BitCast(integers, shifted))));
}

// out[row] = end(start[row] + sum over the columns, its vector).
template <class End>
HWY_INLINE void product(
  FloatsTag d, const GroupedMatrix& matrix, const float* in, float* out, const End& end)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const float* a = matrix.values.data();
  for (Eigen::Index row = 0; row < matrix.rows; row += 4)
  {
    FloatsVector sums[4][Side];
    for (Eigen::Index i = 0; i < 4; ++i)
    {
      std::fill_n(sums[i], Side, hn::Set(d, a[i]));
    }
    a += 4;
    const float* x = in;
    for (Eigen::Index column = 0; column < matrix.columns; ++column, a += 4, x += Side * lanes)
    {
      FloatsVector values[Side];
      for (Eigen::Index part = 0; part < Side; ++part)
      {
        values[part] = hn::LoadU(d, x + part * lanes);
      }
      for (Eigen::Index i = 0; i < 4; ++i)
      {
        const FloatsVector coefficient = hn::Set(d, a[i]);
        for (Eigen::Index part = 0; part < Side; ++part)
        {
          sums[i][part] = fused(coefficient, values[part], sums[i][part]);
        }
      }
    }
    for (const auto& ofRow : sums)
    {
      for (Eigen::Index part = 0; part < Side; ++part, out += lanes)
      {
        hn::StoreU(end(ofRow[part], part, out), d, out);
      }
    }
  }
}

struct ReducedScratch
{
  float* response;
  float* projected;
  float* features; // and behind them the Gaussians
  float* components;
  float* mean;
};

// Channels of pixels as rows of pixels; the last pixel fills up. 'fours' has room for as much: vectors are loaded long
// after the pieces they consist of were stored, else each load would wait for the stores.
HWY_INLINE void loadPixels(FloatsTag d, const float* pixels, Eigen::Index count,
  Eigen::Index channels, float* fours, float* rows)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const Eigen::Index width = Side * lanes;
  for (Eigen::Index pixel = 0; pixel < width; ++pixel)
  {
    const float* from = pixels + std::min(pixel, count - 1) * channels;
    float* to = fours + 4 * pixel;
    Eigen::Index first = 0;
    for (; first + 4 <= channels; first += 4, to += 4 * width)
    {
      std::memcpy(to, from + first, 4 * sizeof(float));
    }
    if (first < channels)
    {
      std::fill(std::copy(from + first, from + channels, to), to + 4, 0.0F);
    }
  }
  // Rows are padded to a multiple of four.
  for (Eigen::Index first = 0; first < channels; first += 4, rows += 4 * width)
  {
    for (float* row = rows; row < rows + width; row += lanes, fours += 4 * lanes)
    {
      FloatsVector v0;
      FloatsVector v1;
      FloatsVector v2;
      FloatsVector v3;
      hn::LoadInterleaved4(d, fours, v0, v1, v2, v3);
      hn::Store(v0, d, row);
      hn::Store(v1, d, row + width);
      hn::Store(v2, d, row + 2 * width);
      hn::Store(v3, d, row + 3 * width);
    }
  }
}

// The other way round. The last bands are written first: what they write too much of, the pixel
// behind them overwrites.
HWY_INLINE void storePixels(
  FloatsTag d, const float* rows, Eigen::Index count, Eigen::Index bands, float* pixels)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const Eigen::Index width = Side * lanes;
  HWY_ALIGN float four[4 * MostFloats];
  for (Eigen::Index first = (bands - 1) / 4 * 4; first >= 0; first -= 4)
  {
    for (Eigen::Index begin = 0; begin < count; begin += lanes)
    {
      const float* row = rows + first * width + begin;
      hn::StoreInterleaved4(hn::LoadU(d, row), hn::LoadU(d, row + width),
        hn::LoadU(d, row + 2 * width), hn::LoadU(d, row + 3 * width), d, four);
      const Eigen::Index last = std::min(lanes, count - begin);
      for (Eigen::Index lane = 0; lane < last; ++lane)
      {
        const Eigen::Index pixel = begin + lane;
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

// Adds one expert's share to the mean of the pixels side by side.
HWY_INLINE void addReducedExpert(FloatsTag d, const ReducedTransferExpert& e, Eigen::Index channels,
  const ReducedScratch& s, bool isFirst)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  FloatsVector norm[Side];
  FloatsVector poison[Side];
  std::fill_n(norm, Side, hn::Zero(d));
  std::fill_n(poison, Side, hn::Zero(d));
  const bool isRoot = e.space == TransferSpace::SquareRoot;
  for (Eigen::Index c = 0; c < channels; ++c)
  {
    const auto i = static_cast<std::size_t>(c);
    for (Eigen::Index part = 0; part < Side; ++part)
    {
      const auto v = hn::LoadU(d, s.response + (Side * c + part) * lanes);
      auto z = hn::Add(hn::Mul(hn::Set(d, e.gain[i]), v), hn::Set(d, e.offset[i]));
      if (isRoot)
      {
        z = hn::CopySign(hn::Sqrt(hn::Abs(z)), z);
      }
      const auto f = hn::Sub(hn::Mul(z, hn::Set(d, e.scale[i])), hn::Set(d, e.center[i]));
      hn::StoreU(f, d, s.features + (Side * c + part) * lanes);
      norm[part] = hn::Add(norm[part], hn::Mul(f, f));
      poison[part] = hn::Add(poison[part], hn::Mul(v, hn::Zero(d)));
    }
  }
  for (FloatsVector& of : norm)
  {
    of = hn::Mul(of, hn::Set(d, e.decay));
  }
  const auto asIs = [](FloatsVector sum, Eigen::Index, const float*) HWY_ATTR { return sum; };
  product(d, e.projection, s.features, s.projected, asIs);
  product(d, e.points, s.projected, s.features + Side * channels * lanes,
    [&](FloatsVector sum, Eigen::Index part, const float*) HWY_ATTR
    { return powerOfTwo(d, hn::Add(sum, norm[part])); });
  const auto addToMean = [&](FloatsVector y, Eigen::Index part, const float* mean) HWY_ATTR
  {
    y = hn::Add(isRoot ? hn::Mul(y, hn::Abs(y)) : y, poison[part]);
    return isFirst ? y : hn::Add(hn::LoadU(d, mean), y);
  };
  if (e.expansion.rows == 0)
  {
    product(d, e.components, s.features, s.mean, addToMean);
    return;
  }
  product(d, e.components, s.features, s.components, asIs);
  product(d, e.expansion, s.components, s.mean, addToMean);
}

// What is read or written next, while there is enough to compute.
HWY_INLINE void prefetch(const float* values, Eigen::Index count)
{
  constexpr Eigen::Index Line = 16;
  for (Eigen::Index i = 0; i < count; i += Line)
  {
    hwy::Prefetch(values + i);
  }
}

void runReducedBlock(
  const ReducedTransfer& mixture, const float* response, float* mean, Eigen::Index pixels)
{
  const FloatsTag d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const auto fourfold = [](Eigen::Index count) { return (count + 3) / 4 * 4; };
  Eigen::Index directions = 0;
  Eigen::Index points = 0;
  Eigen::Index components = 0;
  for (const ReducedTransferExpert& expert : mixture.experts)
  {
    directions = std::max(directions, expert.projection.rows);
    points = std::max(points, expert.points.rows);
    components = std::max(components, expert.components.rows);
  }
  const Eigen::Index channels = fourfold(mixture.channels);
  const Eigen::Index width = Side * lanes;
  const auto memory = hwy::AllocateAligned<float>(static_cast<std::size_t>(
    width * (2 * channels + directions + points + components + fourfold(mixture.bands))));
  ReducedScratch s{};
  s.response = memory.get();
  s.projected = s.response + width * channels;
  s.features = s.projected + width * directions;
  s.components = s.features + width * (channels + points);
  s.mean = s.components + width * components;
  for (Eigen::Index first = 0; first < pixels; first += width)
  {
    const Eigen::Index count = std::min(width, pixels - first);
    loadPixels(
      d, response + first * mixture.channels, count, mixture.channels, s.features, s.response);
    prefetch(response + (first + count) * mixture.channels,
      std::min(width, pixels - first - count) * mixture.channels);
    prefetch(mean + first * mixture.bands, count * mixture.bands);
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

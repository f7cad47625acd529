#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Numerics/NormalDeviateKernel.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Numerics/NormalDeviate.h"
#include "Kernels/Numerics/NormalDeviateKernel.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
std::size_t draw(const NormalDeviate&, std::uint32_t, std::uint32_t, std::uint32_t, std::uint64_t,
  float*, std::size_t)
{
  return 0; // the caller draws what is left, one by one
}
#else
// The upper halves of the 64-bit products.
template <class D, class V>
HWY_INLINE V multiplyHigh(D d, V a, V b)
{
  const hn::RepartitionToWide<D> wide;
  const auto even = hn::MulEven(a, b);
  const auto odd = hn::MulEven(hn::BitCast(d, hn::ShiftRight<32>(hn::BitCast(wide, a))), b);
  return hn::OddEven(hn::BitCast(d, odd), hn::BitCast(d, hn::ShiftRight<32>(even)));
}

#if HWY_HAVE_SCALABLE
template <class D, class V>
HWY_INLINE void loadParabolas(
  D df, const float* table, V cell, hn::Vec<D>& constant, hn::Vec<D>& slope, hn::Vec<D>& bend)
{
  const hn::RebindToSigned<D> di;
  const auto index = hn::BitCast(di, hn::ShiftLeft<2>(cell));
  constant = hn::GatherIndex(df, table, index);
  slope = hn::GatherIndex(df, table + 1, index);
  bend = hn::GatherIndex(df, table + 2, index);
}
#else
// A parabola from each of the places 0, 4, 8, ...
template <class D>
HWY_INLINE hn::Vec<D> loadEveryFourth(D d, const float* table, const std::uint32_t* place)
{
  if constexpr (hn::MaxLanes(D()) <= 4)
  {
    return hn::LoadU(d, table + place[0]);
  }
  else
  {
    const hn::Half<D> half;
    return hn::Combine(d, loadEveryFourth(half, table, place + hn::MaxLanes(D()) / 2),
      loadEveryFourth(half, table, place));
  }
}

// Loads of four values and a transposition: less work than three gathers.
template <class D, class V>
HWY_INLINE void loadParabolas(
  D df, const float* table, V cell, hn::Vec<D>& constant, hn::Vec<D>& slope, hn::Vec<D>& bend)
{
  const hn::RebindToUnsigned<D> du;
  HWY_ALIGN std::uint32_t place[hn::MaxLanes(D())];
  hn::Store(hn::ShiftLeft<2>(cell), du, place);
  const auto a = loadEveryFourth(df, table, place);
  const auto b = loadEveryFourth(df, table, place + 1);
  const auto c = loadEveryFourth(df, table, place + 2);
  const auto e = loadEveryFourth(df, table, place + 3);
  const auto first = hn::InterleaveLower(df, a, c);
  const auto second = hn::InterleaveLower(df, b, e);
  constant = hn::InterleaveLower(df, first, second);
  slope = hn::InterleaveUpper(df, first, second);
  bend = hn::InterleaveLower(df, hn::InterleaveUpper(df, a, c), hn::InterleaveUpper(df, b, e));
}
#endif

// NormalDeviate of every lane. Its exponent and mantissa come from the leading bit of 2 tail + 1.
template <class D, class V>
HWY_INLINE auto deviateOf(D d, V word, const NormalDeviate& table)
{
  const hn::RebindToSigned<D> di;
  const hn::RebindToFloat<D> df;
  const V half = hn::And(word, hn::Set(d, 0x7fffffffU));
  // The place of the leading bit of half, plus one, is the exponent of a float that has it and no long run of
  // ones to round up; zero for half = 0.
  const V sparse = hn::AndNot(hn::ShiftRight<1>(half), half);
  const auto exponent =
    hn::ShiftRight<23>(hn::BitCast(di, hn::ConvertTo(df, hn::BitCast(di, sparse))));
  const V octave = hn::BitCast(d, hn::Max(hn::Zero(di), hn::Sub(exponent, hn::Set(di, 126))));
  const V tail = hn::Or(hn::ShiftLeft<1>(half), hn::Set(d, 1U));
  const V mantissa = hn::Shl(tail, hn::Sub(hn::Set(d, 31U), octave));
  const V cell = hn::Add(hn::ShiftLeft<NormalDeviate::CellBits>(octave),
    hn::ShiftRight<32 - NormalDeviate::CellBits>(hn::ShiftLeft<1>(mantissa)));
  const V below = hn::ShiftRight<32 - NormalDeviate::WithinBits>(
    hn::ShiftLeft<1 + NormalDeviate::CellBits>(mantissa));
  const auto within =
    hn::Mul(hn::ConvertTo(df, hn::BitCast(di, below)), hn::Set(df, NormalDeviate::WithinScale));
  hn::Vec<decltype(df)> constant;
  hn::Vec<decltype(df)> slope;
  hn::Vec<decltype(df)> bend;
  loadParabolas(df, table.parabolas(), cell, constant, slope, bend);
  const auto size = hn::Add(constant, hn::Mul(within, hn::Add(slope, hn::Mul(within, bend))));
  // Negative where the leading bit of the word is not set.
  const V sign = hn::AndNot(word, hn::Set(d, 0x80000000U));
  return hn::BitCast(df, hn::Xor(hn::BitCast(d, size), sign));
}

std::size_t draw(const NormalDeviate& table, std::uint32_t key0, std::uint32_t key1,
  std::uint32_t stream, std::uint64_t first, float* deviates, std::size_t count)
{
  const hn::ScalableTag<std::uint32_t> d;
  const hn::RebindToFloat<decltype(d)> df;
  const std::size_t lanes = hn::Lanes(d);
  const auto multiplier0 = hn::Set(d, Philox::Multiplier0);
  const auto multiplier1 = hn::Set(d, Philox::Multiplier1);
  std::size_t done = 0;
  for (; done + 4 * lanes <= count; done += 4 * lanes)
  {
    const std::uint64_t counter = first + done / 4;
    const auto low = static_cast<std::uint32_t>(counter);
    if (low > 0xffffffffU - lanes)
    {
      break; // the lower half of the counter would wrap within the vector
    }
    auto c0 = hn::Iota(d, low);
    auto c1 = hn::Set(d, static_cast<std::uint32_t>(counter >> 32));
    auto c2 = hn::Set(d, stream);
    auto c3 = hn::Zero(d);
    std::uint32_t k0 = key0;
    std::uint32_t k1 = key1;
    for (int round = 0; round < Philox::Rounds; ++round)
    {
      const auto high0 = multiplyHigh(d, c0, multiplier0);
      const auto high1 = multiplyHigh(d, c2, multiplier1);
      const auto low0 = hn::Mul(c0, multiplier0);
      const auto low1 = hn::Mul(c2, multiplier1);
      c0 = hn::Xor(hn::Xor(high1, c1), hn::Set(d, k0));
      c1 = low1;
      c2 = hn::Xor(hn::Xor(high0, c3), hn::Set(d, k1));
      c3 = low0;
      k0 += Philox::Weyl0;
      k1 += Philox::Weyl1;
    }
    hn::StoreInterleaved4(deviateOf(d, c0, table), deviateOf(d, c1, table), deviateOf(d, c2, table),
      deviateOf(d, c3, table), df, deviates + done);
  }
  return done;
}
#endif

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(draw);

std::size_t drawNormals(std::array<std::uint32_t, 2> key, std::uint32_t stream, std::uint64_t first,
  float* deviates, std::size_t count) noexcept
{
  return HWY_DYNAMIC_DISPATCH(draw)(
    NormalDeviate::instance(), key[0], key[1], stream, first, deviates, count);
}

} // namespace msi
#endif

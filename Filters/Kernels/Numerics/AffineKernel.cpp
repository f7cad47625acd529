#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Numerics/AffineKernel.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Numerics/AffineKernel.h"

#include <hwy/highway.h>

#include <algorithm>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// Outputs first .. first + lanes of one to four neighbouring pixels. Mul and Add, never MulAdd: every
// instruction set rounds the same way.
template <int Pixels, class D, typename T>
HWY_INLINE void runVector(
  D d, const AffineCoefficients<T>& c, Eigen::Index first, const T* in, T* out, Eigen::Index step)
{
  const T* column = c.values + first;
  auto sum0 = hn::LoadU(d, column);
  auto sum1 = sum0;
  auto sum2 = sum0;
  auto sum3 = sum0;
  for (Eigen::Index k = 0; k < c.inputs; ++k)
  {
    column += c.stride;
    const auto coefficient = hn::LoadU(d, column);
    sum0 = hn::Add(sum0, hn::Mul(coefficient, hn::Set(d, in[k])));
    if constexpr (Pixels == 4)
    {
      sum1 = hn::Add(sum1, hn::Mul(coefficient, hn::Set(d, in[k + c.inputs])));
      sum2 = hn::Add(sum2, hn::Mul(coefficient, hn::Set(d, in[k + 2 * c.inputs])));
      sum3 = hn::Add(sum3, hn::Mul(coefficient, hn::Set(d, in[k + 3 * c.inputs])));
    }
  }
  hn::StoreU(sum0, d, out + first);
  if constexpr (Pixels == 4)
  {
    hn::StoreU(sum1, d, out + first + step);
    hn::StoreU(sum2, d, out + first + 2 * step);
    hn::StoreU(sum3, d, out + first + 3 * step);
  }
}

template <int Pixels, class D, typename T>
HWY_INLINE void runPixels(D d, const AffineCoefficients<T>& c, const T* in, T* out)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  Eigen::Index first = 0;
  for (; first + lanes <= c.outputs; first += lanes)
  {
    runVector<Pixels>(d, c, first, in, out, c.outputs);
  }
  if (first < c.outputs)
  {
    // The last vector overlaps the one before: same values, written twice.
    runVector<Pixels>(d, c, c.outputs - lanes, in, out, c.outputs);
  }
}

// Fewer outputs than lanes: through an intermediate, so that nothing is written past the pixel.
template <int Pixels, class D, typename T>
HWY_INLINE void runNarrow(D d, const AffineCoefficients<T>& c, const T* in, T* out)
{
  HWY_ALIGN T padded[Pixels * AffineStrideUnit<T>];
  runVector<Pixels>(d, c, 0, in, padded, AffineStrideUnit<T>);
  for (Eigen::Index p = 0; p < Pixels; ++p)
  {
    std::copy_n(padded + p * AffineStrideUnit<T>, c.outputs, out + p * c.outputs);
  }
}

template <typename T>
HWY_INLINE void runBlock(const AffineCoefficients<T>& c, const T* in, T* out, Eigen::Index pixels)
{
  const hn::CappedTag<T, static_cast<std::size_t>(AffineStrideUnit<T>)> d;
  const bool narrow = c.outputs < static_cast<Eigen::Index>(hn::Lanes(d));
  const auto run = [&](auto count, Eigen::Index p) HWY_ATTR
  {
    constexpr int Pixels = decltype(count)::value;
    const T* pixelIn = in + p * c.inputs;
    T* pixelOut = out + p * c.outputs;
    narrow ? runNarrow<Pixels>(d, c, pixelIn, pixelOut)
           : runPixels<Pixels>(d, c, pixelIn, pixelOut);
  };
  Eigen::Index p = 0;
  for (; p + 4 <= pixels; p += 4)
  {
    run(std::integral_constant<int, 4>(), p);
  }
  for (; p < pixels; ++p)
  {
    run(std::integral_constant<int, 1>(), p);
  }
}

void runDouble(
  const AffineCoefficients<double>& c, const double* in, double* out, Eigen::Index pixels)
{
  runBlock(c, in, out, pixels);
}

void runFloat(const AffineCoefficients<float>& c, const float* in, float* out, Eigen::Index pixels)
{
  runBlock(c, in, out, pixels);
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(runDouble);
HWY_EXPORT(runFloat);

void runAffine(const AffineCoefficients<double>& coefficients, const double* in, double* out,
  Eigen::Index pixels) noexcept
{
  HWY_DYNAMIC_DISPATCH(runDouble)(coefficients, in, out, pixels);
}

void runAffine(const AffineCoefficients<float>& coefficients, const float* in, float* out,
  Eigen::Index pixels) noexcept
{
  HWY_DYNAMIC_DISPATCH(runFloat)(coefficients, in, out, pixels);
}

} // namespace msi
#endif

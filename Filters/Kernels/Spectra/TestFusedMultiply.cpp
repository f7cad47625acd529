// Compiled for the lowest instruction set alone, which on x86 has no fused operation.
#include "Kernels/Spectra/FusedMultiply-inl.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

namespace
{

namespace hn = hwy::HWY_NAMESPACE;
using FusedTag = hn::CappedTag<float, 16>;

// The standard library's fused operation is the independent one.
void expectFused(float a, float x, float b)
{
  const FusedTag d;
  std::array<float, 16> got{};
  hn::StoreU(msi::HWY_NAMESPACE::fusedMultiplyAdd(d, hn::Set(d, a), hn::Set(d, x), hn::Set(d, b)),
    d, got.data());
  const float expected = std::fma(a, x, b);
  ASSERT_TRUE(std::memcmp(&got[0], &expected, sizeof(float)) == 0 ||
    (std::isnan(got[0]) && std::isnan(expected)))
    << a << " * " << x << " + " << b << " gave " << got[0] << ", expected " << expected;
}

TEST(FusedMultiply, RoundsOnce)
{
  std::mt19937 random(2008);
  const auto any = [&]
  {
    std::uint32_t bits = random();
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof(float));
    return value;
  };
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  for (int i = 0; i < 50'000; ++i)
  {
    expectFused(any(), any(), any());
    expectFused(uniform(random), uniform(random), uniform(random));
  }
}

// A product that lies a little beside the middle between two floats: two roundings to nearest, to double and to float,
// would go to the even one of them.
TEST(FusedMultiply, BesideTheMiddle)
{
  for (int exponent = 1; exponent < 60; ++exponent)
  {
    const float little = std::ldexp(1.0F, -exponent);
    for (const float sign : { 1.0F, -1.0F })
    {
      for (const float of : { 1.0F, 1.0F + 0x1p-23F, 1.5F, 2.0F - 0x1p-23F })
      {
        expectFused(0x1p-12F, 0x1p-12F * (1.0F + sign * little), of);
        expectFused(sign * little, 0x1p-30F, of + 0x1p-20F);
        expectFused(-0x1p-12F, 0x1p-13F * (1.0F + sign * little), of);
        expectFused(0x1p-70F * of, 0x1p-79F, sign * little * 0x1p-80F); // denormal results
      }
    }
  }
}

}

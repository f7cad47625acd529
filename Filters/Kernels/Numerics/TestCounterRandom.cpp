#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Numerics/NormalDeviate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace
{

using Words = std::array<std::uint32_t, 4>;

// Known answers published with the Random123 library of the paper's authors.
TEST(CounterRandom, PhiloxGivesThePublishedAnswers)
{
  EXPECT_EQ(msi::philox4x32({ 0, 0, 0, 0 }, { 0, 0 }),
    (Words{ 0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8 }));
  constexpr std::uint32_t Ones = 0xffffffff;
  EXPECT_EQ(msi::philox4x32({ Ones, Ones, Ones, Ones }, { Ones, Ones }),
    (Words{ 0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd }));
  EXPECT_EQ(
    msi::philox4x32({ 0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344 }, { 0xa4093822, 0x299f31d0 }),
    (Words{ 0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1 }));
}

TEST(CounterRandom, UniformHasTheMomentsOfAUniform)
{
  const msi::CounterRandom random(42, 7);
  constexpr int Count = 100000;
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t i = 0; i < Count; ++i)
  {
    const double value = random.uniform(i);
    ASSERT_GT(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    squares += value * value;
  }
  // Five standard errors: sqrt(1/12/n) for the mean, sqrt(4/45/n) for the mean square.
  EXPECT_NEAR(sum / Count, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / Count));
  EXPECT_NEAR(squares / Count, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / Count));
}

TEST(CounterRandom, NormalPairHasTheMomentsOfTwoIndependentNormals)
{
  const msi::CounterRandom random(42, 7);
  constexpr int Count = 100000;
  double sum = 0.0;
  double squares = 0.0;
  double fourths = 0.0;
  double product = 0.0;
  for (std::uint64_t i = 0; i < Count; ++i)
  {
    const auto [a, b] = random.normalPair(i);
    sum += a;
    squares += a * a;
    fourths += b * b * b * b;
    product += a * b;
  }
  const double root = std::sqrt(1.0 / Count);
  EXPECT_NEAR(sum / Count, 0.0, 5.0 * root);
  EXPECT_NEAR(squares / Count, 1.0, 5.0 * std::sqrt(2.0) * root);
  EXPECT_NEAR(fourths / Count, 3.0, 5.0 * std::sqrt(96.0) * root);
  EXPECT_NEAR(product / Count, 0.0, 5.0 * root);
}

// Every quantile against the error function of the C library.
TEST(NormalDeviate, IsTheQuantileOfItsWord)
{
  const msi::NormalDeviate& deviate = msi::NormalDeviate::instance();
  double worst = 0.0;
  for (std::uint64_t word = 0; word < (std::uint64_t{ 1 } << 32U); word += 65521)
  {
    const double x = static_cast<double>(deviate(static_cast<std::uint32_t>(word)));
    const double tail = (static_cast<double>(word & 0x7fffffffU) + 0.5) * 0x1p-32;
    const double found = 0.5 * std::erfc(std::abs(x) / std::sqrt(2.0));
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * 3.141592653589793);
    worst = std::max(worst, std::abs(found - tail) / density);
    ASSERT_EQ(x > 0.0, word >= 0x80000000U);
  }
  EXPECT_LT(worst, 3e-6);
  // scipy.stats.norm.isf(0.5 / 2**32)
  EXPECT_NEAR(static_cast<double>(deviate(0)), -6.337957, 1e-5);
  EXPECT_NEAR(static_cast<double>(deviate(0x80000000U)), 6.337957, 1e-5);
  EXPECT_NEAR(static_cast<double>(deviate(0x7fffffffU)), 0.0, 1e-6);
}

TEST(CounterRandom, NormalsAreTheSameOneByOneAndInAnyRun)
{
  constexpr std::uint64_t Wrap = std::uint64_t{ 1 }
    << 34U; // where the lower half of the counter wraps
  for (const std::uint64_t first : { std::uint64_t{ 0 }, std::uint64_t{ 5 }, Wrap - 70, Wrap - 3 })
  {
    const msi::CounterRandom random(77, 3);
    std::vector<float> run(300);
    random.normals(first, run.data(), run.size());
    for (std::size_t i = 0; i < run.size(); ++i)
    {
      float one = 0.0F;
      random.normals(first + i, &one, 1);
      ASSERT_EQ(run[i], one) << first << " + " << i;
      const std::uint64_t counter = (first + i) / 4;
      const auto words = msi::philox4x32(
        { static_cast<std::uint32_t>(counter), static_cast<std::uint32_t>(counter >> 32U), 3, 0 },
        { 77, 0 });
      ASSERT_EQ(one, msi::NormalDeviate::instance()(words[(first + i) % 4]));
    }
  }
}

TEST(CounterRandom, NormalsHaveTheMomentsOfANormal)
{
  constexpr int Count = 400000;
  std::vector<float> values(Count);
  msi::CounterRandom(8, 1).normals(0, values.data(), Count);
  double sum = 0.0;
  double squares = 0.0;
  double fourths = 0.0;
  double neighbours = 0.0;
  for (std::size_t i = 0; i < Count; ++i)
  {
    const auto x = static_cast<double>(values[i]);
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    neighbours += i > 0 ? x * static_cast<double>(values[i - 1]) : 0.0;
  }
  const double root = std::sqrt(1.0 / Count);
  EXPECT_NEAR(sum / Count, 0.0, 5.0 * root);
  EXPECT_NEAR(squares / Count, 1.0, 5.0 * std::sqrt(2.0) * root);
  EXPECT_NEAR(fourths / Count, 3.0, 5.0 * std::sqrt(96.0) * root);
  EXPECT_NEAR(neighbours / Count, 0.0, 5.0 * root);
}

// Kolmogorov's distance between the sample and the normal distribution; above 1.95 / sqrt(n) with a probability of
// 0.001.
TEST(CounterRandom, NormalsHaveTheDistributionOfANormal)
{
  constexpr std::size_t Count = 200000;
  std::vector<float> values(Count);
  msi::CounterRandom(21, 4).normals(0, values.data(), Count);
  std::sort(values.begin(), values.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < Count; ++i)
  {
    const double cumulated = 0.5 * std::erfc(-static_cast<double>(values[i]) / std::sqrt(2.0));
    const auto rank = static_cast<double>(i);
    distance = std::max({ distance, cumulated - rank / Count, (rank + 1.0) / Count - cumulated });
  }
  EXPECT_LT(distance, 1.95 / std::sqrt(double(Count)));
}

// As many beyond 2, 3 and 4 deviations as a normal distribution has there, on either side.
TEST(CounterRandom, NormalsHaveTheTailsOfANormal)
{
  constexpr std::size_t Count = 4000000;
  std::vector<float> values(Count);
  msi::CounterRandom(22, 4).normals(0, values.data(), Count);
  for (const double limit : { 2.0, 3.0, 4.0 })
  {
    const double expected = 0.5 * std::erfc(limit / std::sqrt(2.0)) * Count;
    for (const double sign : { -1.0, 1.0 })
    {
      const auto beyond = std::count_if(values.begin(), values.end(),
        [limit, sign](float value) { return sign * static_cast<double>(value) > limit; });
      EXPECT_NEAR(static_cast<double>(beyond), expected, 5.0 * std::sqrt(expected)) << sign * limit;
    }
  }
}

TEST(CounterRandom, SeedsStreamsAndIndicesDrawDifferentNumbers)
{
  std::set<double> seen;
  for (const std::uint64_t seed : { 1ULL, 2ULL, 1ULL << 40U })
  {
    for (const std::uint32_t stream : { 0U, 1U })
    {
      for (const std::uint64_t index : { 0ULL, 1ULL, 1ULL << 40U })
      {
        for (const unsigned lane : { 0U, 1U, 2U, 3U })
        {
          seen.insert(msi::CounterRandom(seed, stream).uniform(index, lane));
        }
      }
    }
  }
  EXPECT_EQ(seen.size(), 3U * 2U * 3U * 4U);
}

}

#include "Kernels/Difference/ErrorOrderStatistics.h"
#include "Kernels/Difference/ErrorStatistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using msi::ErrorOrderStatistics;
using msi::ErrorStatistics;
using msi::ErrorSummary;

// The bits of all figures, which tell also NaN from NaN and the two zeros apart.
std::vector<std::uint64_t> bytesOf(const ErrorSummary& summary)
{
  std::vector<std::uint64_t> bytes{ static_cast<std::uint64_t>(summary.count),
    static_cast<std::uint64_t>(summary.nonFinite) };
  for (const double figure :
    { summary.mean, summary.standardDeviation, summary.median, summary.p95, summary.max })
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &figure, sizeof(bits));
    bytes.push_back(bits);
  }
  return bytes;
}

ErrorSummary summaryOf(const std::vector<float>& values)
{
  return msi::summarize(values.data(), values.size());
}

// Values over the whole range of float, with ties, zeros of both signs and values left out.
std::vector<float> mixedValues(std::size_t count)
{
  std::mt19937_64 random(31);
  std::vector<float> values;
  while (values.size() < count)
  {
    switch (random() % 8)
    {
      case 0:
        values.push_back(0.25F);
        break;
      case 1:
        values.push_back(random() % 2 == 0 ? 0.0F : -0.0F);
        break;
      case 2:
        values.push_back(std::numeric_limits<float>::quiet_NaN());
        break;
      case 3:
        values.push_back(-std::numeric_limits<float>::infinity());
        break;
      case 4:
      {
        const auto bits = static_cast<std::uint32_t>(random());
        float value = 0.0F;
        std::memcpy(&value, &bits, sizeof(value));
        values.push_back(value);
        break;
      }
      default:
        values.push_back(static_cast<float>(random() % 100'000) * 1e-4F);
    }
  }
  return values;
}

// Mean and standard deviation from rational arithmetic (Python's fractions), the order statistics from
// numpy, on the same values as float.
TEST(ErrorStatistics, MatchesRationalArithmeticAndNumpy)
{
  const ErrorSummary got =
    summaryOf({ 0.5F, 0.125F, 3.75F, 1.0F, 0.3F, 2.2F, 0.0F, 7.9F, 0.61F, 1.45F, 0.02F });
  EXPECT_EQ(got.count, 11);
  EXPECT_EQ(got.nonFinite, 0);
  EXPECT_DOUBLE_EQ(got.mean, 1.6231818378648974679);
  EXPECT_DOUBLE_EQ(got.standardDeviation, 2.2595497301446495808);
  EXPECT_EQ(got.median, 0.6100000143051147);
  EXPECT_DOUBLE_EQ(got.p95, 5.825000047683716);
  EXPECT_EQ(got.max, 7.900000095367432);
}

TEST(ErrorStatistics, NoDigitIsLostToCancellation)
{
  // 2^24 + 4 k, k = 0..9: the deviation of 0..9, times 4.
  std::vector<float> shifted;
  shifted.reserve(10);
  for (int k = 0; k < 10; ++k)
  {
    shifted.push_back(16'777'216.0F + 4.0F * static_cast<float>(k));
  }
  EXPECT_EQ(summaryOf(shifted).mean, 16'777'234.0);
  EXPECT_DOUBLE_EQ(summaryOf(shifted).standardDeviation, 4.0 * std::sqrt(8.25));
  // The smallest float beside the largest ones, which cancel.
  const float largest = std::numeric_limits<float>::max();
  const float smallest = std::numeric_limits<float>::denorm_min();
  const ErrorSummary extremes = summaryOf({ largest, smallest, -largest, -largest, largest });
  EXPECT_EQ(extremes.mean, std::ldexp(1.0, -149) / 5.0);
  EXPECT_DOUBLE_EQ(extremes.standardDeviation, static_cast<double>(largest) * std::sqrt(4.0 / 5.0));
  EXPECT_EQ(extremes.median, static_cast<double>(smallest));
  EXPECT_EQ(summaryOf({ -3.0F, -1.0F }).mean, -2.0);
  EXPECT_EQ(summaryOf({ 0.1F, 0.1F, 0.1F }).standardDeviation, 0.0);
}

TEST(ErrorStatistics, OrderStatisticsAreThoseOfTheSortedList)
{
  for (const std::size_t count : { 1U, 2U, 3U, 20U, 21U, 1000U, 30'000U })
  {
    const std::vector<float> values = mixedValues(count);
    std::vector<double> sorted;
    std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
      [](float value) { return std::isfinite(value); });
    std::sort(sorted.begin(), sorted.end());
    const ErrorSummary got = summaryOf(values);
    ASSERT_EQ(static_cast<std::size_t>(got.count), sorted.size());
    EXPECT_EQ(static_cast<std::size_t>(got.nonFinite), count - sorted.size());
    if (sorted.empty())
    {
      continue;
    }
    const Eigen::Map<const Eigen::VectorXd> list(
      sorted.data(), static_cast<Eigen::Index>(sorted.size()));
    EXPECT_EQ(got.max, sorted.back());
    EXPECT_EQ(got.median, msi::percentile(list, 50.0));
    EXPECT_EQ(got.p95, msi::percentile(list, 95.0));
  }
}

TEST(ErrorStatistics, TheSameBytesForEveryPartitionAndOrder)
{
  const std::vector<float> values = mixedValues(20'000);
  const ErrorSummary whole = summaryOf(values);
  std::mt19937_64 random(7);
  for (const std::size_t parts : { 2U, 3U, 16U })
  {
    std::vector<std::vector<float>> pieces(parts);
    for (const float value : values)
    {
      pieces[random() % parts].push_back(value);
    }
    std::shuffle(pieces.begin(), pieces.end(), random);
    ErrorStatistics first;
    for (const auto& piece : pieces)
    {
      ErrorStatistics part;
      part.add(piece.data(), piece.size());
      first.merge(part);
    }
    ErrorOrderStatistics second(first);
    for (const auto& piece : pieces)
    {
      ErrorOrderStatistics part(first);
      part.add(piece.data(), piece.size() / 3);
      part.add(piece.data() + piece.size() / 3, piece.size() - piece.size() / 3);
      second.merge(part);
    }
    EXPECT_EQ(bytesOf(second.summary()), bytesOf(whole)) << parts << " parts";
  }
}

// What an MPI reduction by MPI_SUM over ranks does.
TEST(ErrorStatistics, ArraysAddUpOverRanks)
{
  const std::vector<float> values = mixedValues(5'000);
  const auto sum = [](std::vector<std::int64_t> a, const std::vector<std::int64_t>& b)
  {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
    return a;
  };
  ErrorStatistics ranks[2];
  ranks[0].add(values.data(), 1'234);
  ranks[1].add(values.data() + 1'234, values.size() - 1'234);
  const auto first = ErrorStatistics::fromArray(sum(ranks[0].toArray(), ranks[1].toArray()));

  ErrorOrderStatistics orders[2] = { ErrorOrderStatistics(first), ErrorOrderStatistics(first) };
  orders[0].add(values.data(), 1'234);
  orders[1].add(values.data() + 1'234, values.size() - 1'234);
  ErrorOrderStatistics second(first);
  second.setArray(sum(orders[0].toArray(), orders[1].toArray()));
  EXPECT_EQ(bytesOf(second.summary()), bytesOf(summaryOf(values)));
}

TEST(ErrorStatistics, NothingFiniteIsSaidSo)
{
  for (const auto& values :
    { std::vector<float>{}, std::vector<float>{ std::nanf(""), HUGE_VALF, -HUGE_VALF } })
  {
    const ErrorSummary got = summaryOf(values);
    EXPECT_EQ(got.count, 0);
    EXPECT_EQ(static_cast<std::size_t>(got.nonFinite), values.size());
    EXPECT_TRUE(std::isnan(got.mean) && std::isnan(got.standardDeviation) &&
      std::isnan(got.median) && std::isnan(got.p95) && std::isnan(got.max));
  }
}

TEST(ErrorStatistics, RefusesAnArrayOfAnotherLength)
{
  try
  {
    ErrorStatistics::fromArray(std::vector<std::int64_t>(3));
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(
      error.what(), "an array of 3 integers is not the state of ErrorStatistics, which has 66300");
  }
  ErrorStatistics first;
  const float one = 1.0F;
  first.add(&one, 1);
  EXPECT_THROW(
    ErrorOrderStatistics(first).setArray(std::vector<std::int64_t>(7)), std::invalid_argument);
}

TEST(ErrorStatistics, ASecondPassOverOtherValuesIsNoticed)
{
  const std::vector<float> values{ 1.0F, 2.0F, 3.0F };
  ErrorStatistics first;
  first.add(values.data(), values.size());
  ErrorOrderStatistics second(first);
  second.add(values.data(), 1);
  EXPECT_THROW(second.summary(), std::logic_error);
}

}

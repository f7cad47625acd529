#include "Kernels/Sampling/PatchStatistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{

TEST(ExactSum, KeepsWhatFloatingPointLoses)
{
  msi::ExactSum sum;
  sum.add(1e9);
  for (int i = 0; i < 1024; ++i)
  {
    sum.add(std::ldexp(1.0, -40));
  }
  sum.add(-1e9);
  EXPECT_EQ(sum.value(), std::ldexp(1.0, -30));
}

TEST(ExactSum, LimbsAddUpOverRanks)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> values(-1e6, 1e6);
  msi::ExactSum whole;
  msi::ExactSum::Limbs total{};
  for (int rank = 0; rank < 9; ++rank)
  {
    msi::ExactSum part;
    for (int i = 0; i < 100; ++i)
    {
      const double value = values(random);
      whole.add(value);
      part.add(value);
    }
    const auto limbs = part.limbs();
    for (std::size_t i = 0; i < total.size(); ++i)
    {
      total[i] += limbs[i];
    }
  }
  EXPECT_EQ(msi::ExactSum::fromLimbs(total).value(), whole.value());
}

TEST(PatchStatistics, MeanDeviationAndCenterOfKnownPixels)
{
  msi::PatchStatistics statistics(2, 2);
  const float pixels[3][2] = { { 1.0f, 10.0f }, { 2.0f, 10.0f }, { 6.0f, 10.0f } };
  for (int i = 0; i < 3; ++i)
  {
    statistics.add(2, i, 5.0, pixels[i]);
  }
  statistics.add(0, 100.0, 100.0, pixels[0]);
  EXPECT_EQ(statistics.count(1), 0);
  EXPECT_TRUE(std::isnan(statistics.mean(1)[0]));
  EXPECT_EQ(statistics.count(2), 3);
  EXPECT_EQ(statistics.mean(2), Eigen::Vector2d(3.0, 10.0));
  EXPECT_DOUBLE_EQ(statistics.standardDeviation(2)[0], std::sqrt(7.0)); // (4 + 1 + 9) / 2
  EXPECT_EQ(statistics.standardDeviation(2)[1], 0.0);
  EXPECT_EQ(statistics.center(2), Eigen::Vector2d(1.0, 5.0));
}

TEST(PatchStatistics, OnePixelHasNoDeviation)
{
  msi::PatchStatistics statistics(1, 1);
  const float pixel = 0.5f;
  statistics.add(1, 0.0, 0.0, &pixel);
  EXPECT_EQ(statistics.mean(1)[0], 0.5);
  EXPECT_TRUE(std::isnan(statistics.standardDeviation(1)[0]));
}

TEST(PatchStatistics, LeavesOutPixelsThatAreNotFiniteAndCountsThem)
{
  msi::PatchStatistics statistics(1, 2);
  const float good[] = { 0.25f, 0.5f };
  const float bad[] = { 0.25f, std::numeric_limits<float>::quiet_NaN() };
  const float infinite[] = { std::numeric_limits<float>::infinity(), 0.0f };
  statistics.add(1, 0, 0, good);
  statistics.add(1, 0, 0, bad);
  statistics.add(1, 0, 0, infinite);
  EXPECT_EQ(statistics.count(1), 1);
  EXPECT_EQ(statistics.leftOut(1), 2);
  EXPECT_EQ(statistics.mean(1), Eigen::Vector2d(0.25, 0.5));
}

TEST(PatchStatistics, AnySplitGivesTheSameBytes)
{
  std::mt19937_64 random(3);
  std::lognormal_distribution<float> values(0.0f, 3.0f);
  std::uniform_int_distribution<int> labels(0, 5);
  msi::PatchStatistics whole(5, 3);
  std::vector<msi::PatchStatistics> parts(4, msi::PatchStatistics(5, 3));
  for (int i = 0; i < 5000; ++i)
  {
    const float pixel[] = { values(random), -values(random), values(random) };
    const int label = labels(random);
    whole.add(label, i, 2 * i, pixel);
    parts[static_cast<std::size_t>(i * 7 % 4)].add(label, i, 2 * i, pixel);
  }
  auto total = parts[3].toArray();
  for (std::size_t part = 0; part < 3; ++part)
  {
    const auto array = parts[part].toArray();
    for (std::size_t i = 0; i < total.size(); ++i)
    {
      total[i] += array[i];
    }
  }
  msi::PatchStatistics summed(5, 3);
  summed.setArray(total);
  for (int i = 0; i < 3; ++i)
  {
    parts[3].merge(parts[static_cast<std::size_t>(i)]);
  }
  for (int label = 1; label <= 5; ++label)
  {
    EXPECT_EQ(summed.mean(label), whole.mean(label));
    EXPECT_EQ(parts[3].mean(label), whole.mean(label));
    EXPECT_EQ(summed.standardDeviation(label), whole.standardDeviation(label));
    EXPECT_EQ(summed.center(label), whole.center(label));
    EXPECT_EQ(summed.count(label), whole.count(label));
  }
}

}

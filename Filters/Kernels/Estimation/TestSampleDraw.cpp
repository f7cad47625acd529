#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/SampleDraw.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using Indices = std::vector<Eigen::Index>;

// Values of a separate Python program with its own mt19937_64, checked on the 10000th output that the
// C++ standard gives.
TEST(SampleDraw, GivesTheSameIndicesOnEveryPlatform)
{
  EXPECT_EQ(msi::drawSamples(204, 16, 1, 0),
    (Indices{ 3, 9, 30, 34, 36, 37, 62, 66, 71, 73, 98, 102, 152, 156, 171, 178 }));
  EXPECT_EQ(msi::drawSamples(204, 16, 1, 1),
    (Indices{ 12, 17, 19, 20, 45, 66, 82, 97, 103, 105, 110, 114, 118, 173, 185, 189 }));
  EXPECT_EQ(msi::drawSamples(10, 6, 2, 0), (Indices{ 0, 1, 2, 3, 5, 6 }));
}

TEST(SampleDraw, TakesEverySampleEquallyOften)
{
  constexpr int draws = 4000;
  std::vector<int> hits(10, 0);
  for (std::uint64_t draw = 0; draw < draws; ++draw)
  {
    for (const Eigen::Index i : msi::drawSamples(10, 3, 7, draw))
    {
      ++hits.at(static_cast<std::size_t>(i));
    }
  }
  // Binomial(4000, 0.3): mean 1200, standard deviation 29; five of them.
  for (const int count : hits)
  {
    EXPECT_NEAR(count, 1200, 145);
  }
}

TEST(SampleDraw, SplitsThePopulation)
{
  EXPECT_EQ(msi::drawSamples(4, 4, 1, 0), (Indices{ 0, 1, 2, 3 }));
  EXPECT_TRUE(msi::drawSamples(4, 0, 1, 0).empty());
  const auto chosen = msi::drawSamples(50, 20, 3, 9);
  Indices all = msi::remainingSamples(50, chosen);
  EXPECT_EQ(all.size(), 30U);
  all.insert(all.end(), chosen.begin(), chosen.end());
  std::sort(all.begin(), all.end());
  for (Eigen::Index i = 0; i < 50; ++i)
  {
    EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
  }
}

TEST(SampleDraw, LeavesOutEverySampleInOneFold)
{
  using Folds = std::vector<Indices>;
  EXPECT_EQ(msi::leftOutFolds(5, 2), (Folds{ { 0, 2, 4 }, { 1, 3 } }));
  EXPECT_EQ(msi::leftOutFolds(3, 8), (Folds{ { 0 }, { 1 }, { 2 } }));
}

TEST(SampleDraw, RefusesMoreThanThereAre)
{
  EXPECT_EQ(msi::test::messageOf([] { msi::drawSamples(3, 4, 1, 0); }),
    "4 samples are to be drawn from 3; expected a number from 0 to 3");
}

}

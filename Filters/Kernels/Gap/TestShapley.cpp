#include "Kernels/Gap/ReportParts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

TEST(Shapley, AdditivePlayersGetWhatTheyBring)
{
  std::vector<double> value(8);
  const double brings[3] = { 0.5, 2.0, -1.0 };
  for (std::size_t subset = 0; subset < 8; ++subset)
  {
    for (std::size_t player = 0; player < 3; ++player)
    {
      value[subset] += (subset >> player & 1U) != 0 ? brings[player] : 0.0;
    }
  }
  const std::vector<double> shares = msi::shapleyValues(value, 3);
  ASSERT_EQ(shares.size(), 3U);
  for (std::size_t player = 0; player < 3; ++player)
  {
    EXPECT_NEAR(shares[player], brings[player], 1e-15);
  }
}

// The glove game: players 0 and 1 have a left glove each, player 2 the right one; a pair is worth 1.
// Closed form 1/6, 1/6, 2/3.
TEST(Shapley, GloveGameHasItsClosedForm)
{
  const std::vector<double> value{ 0, 0, 0, 0, 0, 1, 1, 1 };
  const std::vector<double> shares = msi::shapleyValues(value, 3);
  EXPECT_NEAR(shares[0], 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(shares[1], 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(shares[2], 2.0 / 3.0, 1e-15);
}

// The airport game: a runway of length c serves everybody who needs up to c. Each section is shared evenly by those
// who use it (S. C. Littlechild, G. Owen, 1973).
TEST(Shapley, AirportGameSharesEverySectionEvenly)
{
  const double need[4] = { 1.0, 3.0, 3.5, 7.0 };
  std::vector<double> value(16);
  for (std::size_t subset = 0; subset < 16; ++subset)
  {
    for (std::size_t player = 0; player < 4; ++player)
    {
      value[subset] = std::fmax(value[subset], (subset >> player & 1U) != 0 ? need[player] : 0.0);
    }
  }
  const std::vector<double> shares = msi::shapleyValues(value, 4);
  EXPECT_NEAR(shares[0], 1.0 / 4, 1e-14);
  EXPECT_NEAR(shares[1], 1.0 / 4 + 2.0 / 3, 1e-14);
  EXPECT_NEAR(shares[2], 1.0 / 4 + 2.0 / 3 + 0.5 / 2, 1e-14);
  EXPECT_NEAR(shares[3], 1.0 / 4 + 2.0 / 3 + 0.5 / 2 + 3.5, 1e-14);
}

TEST(Shapley, NobodyAndOne)
{
  EXPECT_TRUE(msi::shapleyValues({ 0.3 }, 0).empty());
  EXPECT_EQ(msi::shapleyValues({ 0.25, 1.0 }, 1), std::vector<double>{ 0.75 });
}

} // namespace

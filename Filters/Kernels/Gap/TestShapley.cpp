#include "Kernels/Gap/ReportParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

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

// The range of a filter's width ends at .3 and at 3; that of a gain's is not reached, and a sharp end of the response says nothing.
TEST(NoteDoubts, SaysWhatIsAtTheEndOfItsRange)
{
  msi::GapReport report;
  msi::GapCause width;
  width.effect = "filter_bandwidth";
  width.form = "per_channel";
  width.parameters = { { "factor[C1]", 0.3, "1" }, { "factor[C2]", 1.2, "1" },
    { "factor[C3]", 0.3, "1" } };
  msi::GapCause gain;
  gain.effect = "exposure_gain";
  gain.form = "common";
  gain.parameters = { { "gain", 1.1, "1" } };
  msi::GapCause clipped; // as sharp as can be
  clipped.effect = "saturation";
  clipped.form = "soft";
  clipped.parameters = { { "level", 0.9, "white" }, { "softness", 0.001, "white" } };
  report.causes = { width, gain, clipped };
  std::vector<std::string> notes;
  msi::noteDoubts(notes, report);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("filter_bandwidth"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("factor 0.3 (in 2 of 3 channels)"), std::string::npos) << notes[0];
}

} // namespace

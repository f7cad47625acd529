#include "SpectralAxis.h"

#include "Support/vtk/ErrorText.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using msi::testing::argumentError;

SpectralAxis numbered(int count)
{
  SpectralAxis axis;
  for (int i = 1; i <= count; ++i)
  {
    axis.names.push_back("C" + std::to_string(i));
  }
  return axis;
}

TEST(SpectralAxis, WritesWavelengthsAsShortAsTheyAre)
{
  EXPECT_EQ(wavelengthText(400.0), "400");
  EXPECT_EQ(wavelengthText(402.5), "402.5");
  EXPECT_EQ(
    axisOf(WavelengthGrid({ 380.0, 380.1 })).names, (std::vector<std::string>{ "380", "380.1" }));
}

TEST(SpectralAxis, DescribesItself)
{
  EXPECT_EQ(describe(axisOf(WavelengthGrid::uniform(400, 700, 20)), "channels"),
    "16 channels (400, 420, .., 700 nm)");
  EXPECT_EQ(describe(axisOf(WavelengthGrid({ 400.0, 500.0, 600.0, 700.0 })), "bands"),
    "4 bands (400, 500, 600, 700 nm)");
  EXPECT_EQ(describe(numbered(9), "channels"), "9 channels (C1, C2, .., C9)");
  EXPECT_EQ(describe(numbered(1), "channels"), "1 channels (C1)");
}

TEST(SpectralAxis, TakesWavelengthsWithinHalfANanometreForTheSame)
{
  const auto a = axisOf(WavelengthGrid({ 400.0, 500.0 }));
  EXPECT_EQ(argumentError(
              [&] {
                requireSameChannels(a, "A", axisOf(WavelengthGrid({ 400.5, 499.5 })), "B");
              }),
    "");
  EXPECT_EQ(argumentError(
              [&] {
                requireSameChannels(a, "A", axisOf(WavelengthGrid({ 400.0, 500.6 })), "B");
              }),
    "A has 2 channels (400, 500 nm), but B has 2 channels (400, 500.6 nm); both must come from the "
    "same "
    "camera with the same channels");
}

TEST(SpectralAxis, NamesBothNumbersOfChannels)
{
  EXPECT_EQ(argumentError(
              [&]
              {
                requireSameChannels(axisOf(WavelengthGrid::uniform(400, 700, 20)),
                  "the calibration", axisOf(WavelengthGrid::uniform(400, 700, 50)), "the image");
              }),
    "the calibration has 16 channels (400, 420, .., 700 nm), but the image has 7 channels (400, "
    "450, .., "
    "700 nm); both must come from the same camera with the same channels");
}

TEST(SpectralAxis, TakesNumberedChannelsForThoseOfAKnownCamera)
{
  const auto known = axisOf(WavelengthGrid({ 400.0, 500.0 }));
  EXPECT_EQ(argumentError([&] { requireSameChannels(numbered(2), "A", known, "B"); }), "");
  EXPECT_EQ(argumentError([&] { requireSameChannels(known, "A", numbered(2), "B"); }), "");
  EXPECT_EQ(argumentError([&] { requireSameChannels(known, "A", numbered(3), "B"); }),
    "A has 2 channels (400, 500 nm), but B has 3 channels (C1, C2, C3); both must come from the "
    "same "
    "camera with the same channels");
}

TEST(SpectralAxis, SaysToResampleBandsThatDiffer)
{
  EXPECT_EQ(argumentError(
              [&]
              {
                requireSameBands(axisOf(WavelengthGrid({ 400.0, 410.0 })), "the chart",
                  axisOf(WavelengthGrid({ 400.0, 405.0, 410.0 })), "the fabric");
              }),
    "the chart has 2 bands (400, 410 nm), but the fabric has 3 bands (400, 405, 410 nm); resample "
    "one of "
    "them first");
}
}

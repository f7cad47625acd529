#include "Kernels/Spectra/WavelengthGrid.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace
{

std::string messageOf(std::vector<double> nanometres)
{
  try
  {
    msi::WavelengthGrid grid(std::move(nanometres));
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

TEST(WavelengthGrid, UniformGridHoldsBothEnds)
{
  const auto grid = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);
  EXPECT_EQ(grid.size(), 31);
  EXPECT_EQ(grid.front(), 400.0);
  EXPECT_EQ(grid.back(), 700.0);
  ASSERT_TRUE(grid.step().has_value());
  EXPECT_DOUBLE_EQ(*grid.step(), 10.0);
}

TEST(WavelengthGrid, UnevenSpacingHasNoStep)
{
  EXPECT_FALSE(msi::WavelengthGrid({ 400.0, 420.0, 450.0 }).step().has_value());
  EXPECT_FALSE(msi::WavelengthGrid({ 550.0 }).step().has_value());
}

TEST(WavelengthGrid, RefusesWhatIsNoGridAndSaysWhere)
{
  EXPECT_EQ(messageOf({}), "a wavelength grid needs at least one wavelength");
  EXPECT_EQ(messageOf({ 400.0, 400.0 }),
    "wavelength 2 is 400 nm; expected wavelengths in strictly increasing order");
  EXPECT_EQ(
    messageOf({ 0.4, 0.5 }), "wavelength 1 is 0.4 nm; expected a value from 100 to 20000 nm");
  EXPECT_NE(messageOf({ 400.0, std::numeric_limits<double>::quiet_NaN() }), "");
  EXPECT_THROW(msi::WavelengthGrid::uniform(400.0, 705.0, 10.0), std::invalid_argument);
  EXPECT_THROW(msi::WavelengthGrid::uniform(400.0, 700.0, -10.0), std::invalid_argument);
}

}

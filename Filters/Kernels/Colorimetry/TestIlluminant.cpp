#include "Kernels/Colorimetry/Illuminant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace
{

using msi::Illuminant;
using msi::WavelengthGrid;

double powerAt(const Illuminant& illuminant, double wavelength)
{
  for (Eigen::Index i = 0; i < illuminant.wavelengths().size(); ++i)
  {
    if (illuminant.wavelengths()[i] == wavelength)
    {
      return illuminant.power()(i);
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string messageOf(const WavelengthGrid& wavelengths, const Eigen::VectorXd& power)
{
  try
  {
    Illuminant("lamp", wavelengths, power);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

// ISO/CIE 11664-2: S_A = 100 (560 / l)^5 (exp(1.435e7 / (2848 * 560)) - 1)
//                            / (exp(1.435e7 / (2848 l)) - 1).
TEST(Illuminant, AFollowsItsFormula)
{
  const Illuminant illuminant = Illuminant::named("A");
  for (Eigen::Index i = 0; i < illuminant.power().size(); ++i)
  {
    const double wavelength = illuminant.wavelengths()[i];
    const double expected = 100.0 * std::pow(560.0 / wavelength, 5) *
      std::expm1(1.435e7 / (2848.0 * 560.0)) / std::expm1(1.435e7 / (2848.0 * wavelength));
    EXPECT_NEAR(illuminant.power()(i), expected, 1e-5 * expected) << wavelength << " nm";
  }
}

TEST(Illuminant, DaylightIsNormalizedAt560Nanometres)
{
  EXPECT_EQ(powerAt(Illuminant::named("D65"), 560.0), 100.0);
  EXPECT_EQ(powerAt(Illuminant::named("D50"), 560.0), 100.0);
}

TEST(Illuminant, AllNamesAreThere)
{
  const auto names = Illuminant::names();
  ASSERT_EQ(names.size(), 25U);
  EXPECT_EQ(names.front(), "A");
  EXPECT_EQ(names[4], "FL1");
  EXPECT_EQ(names.back(), "LED-V2");
  for (const auto& name : names)
  {
    const Illuminant illuminant = Illuminant::named(name);
    EXPECT_EQ(illuminant.name(), name);
    EXPECT_EQ(illuminant.wavelengths().back(), 780.0);
    EXPECT_LE(illuminant.wavelengths().front(), 380.0);
    EXPECT_EQ(*illuminant.wavelengths().step(), 5.0);
  }
}

double largestDifference(const Illuminant& a, const Illuminant& b)
{
  const auto grid = WavelengthGrid::uniform(380.0, 780.0, 1.0);
  return (a.powerAt(grid) - b.powerAt(grid)).cwiseAbs().maxCoeff();
}

// The tables of the standard hold D50 and D65 to four digits.
TEST(Illuminant, DaylightByTemperatureIsThatOfTheTables)
{
  const double nominal = 1.4388 / 1.4380;
  const auto byTemperature = [](double kelvin)
  { return Illuminant::named("D" + std::to_string(kelvin) + "K"); };
  EXPECT_LT(largestDifference(byTemperature(5000.0 * nominal), Illuminant::named("D50")), 1e-3);
  EXPECT_LT(largestDifference(byTemperature(6500.0 * nominal), Illuminant::named("D65")), 1e-3);
  // As CIE 15:2004 tabulates D55.
  const Illuminant d55 = Illuminant::named("d55");
  EXPECT_NEAR(powerAt(d55, 300.0), 0.024, 6e-4);
  EXPECT_NEAR(powerAt(d55, 400.0), 60.949, 6e-4);
  EXPECT_NEAR(powerAt(d55, 600.0), 94.419, 6e-4);
  EXPECT_NEAR(powerAt(d55, 780.0), 71.818, 6e-4);
}

// A is a blackbody of 2848 K times the ratio of today's second radiation constant to 1.435e-2 m K.
TEST(Illuminant, ABlackbodyOfItsTemperatureIsA)
{
  const double kelvin = 2848.0 * 1.438776877 / 1.435;
  const Illuminant blackbody = Illuminant::named("bb" + std::to_string(kelvin) + "K");
  EXPECT_LT(largestDifference(blackbody, Illuminant::named("A")), 2e-3);
  EXPECT_EQ(powerAt(blackbody, 560.0), 100.0);
}

TEST(Illuminant, TradeNamesAndEqualEnergy)
{
  EXPECT_EQ(Illuminant::named("TL84").name(), "FL11");
  EXPECT_EQ(Illuminant::named("tl83").name(), "FL12");
  EXPECT_EQ(Illuminant::named("TL85").name(), "FL10");
  EXPECT_EQ(Illuminant::named("CWF").name(), "FL2");
  EXPECT_EQ(Illuminant::named("e").power().minCoeff(), Illuminant::named("E").power().maxCoeff());
}

TEST(Illuminant, ATemperatureOutOfRangeIsSaid)
{
  const auto message = [](const char* name) -> std::string
  {
    try
    {
      Illuminant::named(name);
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(
    message("D3000K"), "illuminant 'D3000K' has the temperature 3000 K; expected 4000 to 25000 K");
  EXPECT_EQ(
    message("BB10K"), "illuminant 'BB10K' has the temperature 10 K; expected 1000 to 100000 K");
  EXPECT_NE(message("D30"), "");
  EXPECT_NE(message("D5500X"), "");
  EXPECT_NE(message("BB-5K"), "");
}

TEST(Illuminant, OldNamesAndSmallLettersAreUnderstood)
{
  EXPECT_EQ(Illuminant::named("F2").name(), "FL2");
  EXPECT_EQ(Illuminant::named("f12").power(), Illuminant::named("FL12").power());
  EXPECT_EQ(Illuminant::named("led-b1").name(), "LED-B1");
}

TEST(Illuminant, TemperaturesAreUnderstoodAsTheyAreTyped)
{
  EXPECT_EQ(Illuminant::named("D5300").power(), Illuminant::named("D5300K").power());
  EXPECT_EQ(Illuminant::named("d 5300 k").power(), Illuminant::named("D5300K").power());
  EXPECT_EQ(Illuminant::named("3200 K").power(), Illuminant::named("BB3200K").power());
  // Daylight or a blackbody: it is not said which.
  EXPECT_THROW(Illuminant::named("5300 K"), std::invalid_argument);
}

TEST(Illuminant, AnUnknownNameListsTheKnownOnes)
{
  for (const char* name : { "D5x", "F13", "", "2deg" })
  {
    try
    {
      Illuminant::named(name);
      FAIL() << "accepted " << name;
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_EQ(std::string(error.what()),
        "unknown illuminant '" + std::string(name) +
          "'; known are: A C D50 D65 FL1 FL2 FL3 FL4 FL5 FL6 FL7 FL8 FL9 FL10 FL11 FL12 LED-B1 "
          "LED-B2 LED-B3 LED-B4 LED-B5 LED-BH1 LED-RGB1 LED-V1 LED-V2 E, F1 to F12 for FL1 to "
          "FL12, CWF TL83 TL84 TL85, D55 D75 and the like, and by temperature D5500K (daylight) "
          "and BB3200K (blackbody)");
    }
  }
}

TEST(Illuminant, RefusesWhatIsNoPowerDistribution)
{
  const WavelengthGrid grid({ 400.0, 500.0, 600.0 });
  EXPECT_EQ(messageOf(grid, Eigen::Vector2d(1.0, 2.0)),
    "illuminant 'lamp' has 2 values of power for 3 wavelengths; expected one each");
  EXPECT_EQ(messageOf(grid, Eigen::Vector3d(1.0, -2.0, 1.0)),
    "illuminant 'lamp' has the power -2 at 500 nm; expected a finite value that is not negative");
  EXPECT_NE(messageOf(grid, Eigen::Vector3d(1.0, 2.0, std::nan(""))), "");
  EXPECT_EQ(
    messageOf(grid, Eigen::Vector3d::Zero()), "illuminant 'lamp' has no power at any wavelength");
  EXPECT_EQ(messageOf(grid, Eigen::Vector3d(0.0, 2.0, 0.0)), "");
}

}

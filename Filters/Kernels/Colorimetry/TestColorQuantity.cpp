#include "Kernels/Colorimetry/ColorQuantity.h"

#include "Kernels/Colorimetry/ChromaticAdaptation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d whiteAt(double x, double y)
{
  return 100.0 * Vector3d(x / y, 1.0, (1.0 - x - y) / y);
}

Vector2d quantity(const char* name, const Vector3d& white, const Vector3d& xyz, bool ten = false)
{
  return msi::colorQuantityNamed(name).of({ white, ten }, xyz);
}

// Of the test suite of colour-science.
TEST(ColorQuantity, LuvIsThatOfColourScience)
{
  const Vector3d red(20.654008, 12.197225, 5.136952);
  const auto apart = [](const Vector2d& got, double u, double v)
  { return (got - Vector2d(u, v)).cwiseAbs().maxCoeff(); };
  EXPECT_LT(apart(quantity("Luv", whiteAt(0.3127, 0.3290), red), 96.83626054, 17.75210149), 1e-6);
  EXPECT_LT(
    apart(quantity("Luv", whiteAt(0.44757, 0.40745), red), 65.45180940, -12.46626977), 1e-6);
  EXPECT_LT(apart(quantity("Luv", whiteAt(0.34570, 0.35850), red), 90.70925962, 7.08455273), 1e-6);
  EXPECT_EQ(quantity("Luv", whiteAt(0.3127, 0.3290), Vector3d::Zero()), Vector2d::Zero());
}

// The example of colour-science for CIE 15:2004: W 93.85, T -1.305.
TEST(ColorQuantity, WhitenessAndTintAreThoseOfColourScience)
{
  const Vector3d white = whiteAt(0.3139, 0.3311);
  const Vector3d paper = whiteAt(0.3167, 0.3334);
  EXPECT_LT(
    (quantity("whiteness", white, paper) - Vector2d(93.85, -1.305)).cwiseAbs().maxCoeff(), 1e-10);
  // 10 degrees: 900 in the place of 1000.
  EXPECT_NEAR(quantity("whiteness", white, paper, true)(1), -1.025, 1e-10);
  EXPECT_LT(
    (quantity("whiteness", white, white) - Vector2d(100.0, 0.0)).cwiseAbs().maxCoeff(), 1e-10);
  // Beyond the limits of the formula: a red, and a gray.
  EXPECT_TRUE(quantity("whiteness", white, { 40.0, 20.0, 5.0 }).hasNaN());
  EXPECT_TRUE(quantity("whiteness", white, 0.5 * white).hasNaN());
}

TEST(ColorQuantity, ChromaticityAndPolarCoordinates)
{
  const Vector3d white = whiteAt(0.3127, 0.3290);
  EXPECT_LT(
    (quantity("xyY", white, 0.2 * white) - Vector2d(0.3127, 0.3290)).cwiseAbs().maxCoeff(), 1e-12);
  // a* = b*: X/Xn and Y/Yn chosen so that f differs by 0.04, and f(Y) - f(Z) by 0.1.
  const double y = 0.5;
  const Vector3d diagonal(
    white(0) * std::pow(y + 0.04, 3), 100.0 * std::pow(y, 3), white(2) * std::pow(y - 0.1, 3));
  const Vector2d polar = quantity("LCh", white, diagonal);
  EXPECT_NEAR(polar(0), std::hypot(20.0, 20.0), 1e-10);
  EXPECT_NEAR(polar(1), 45.0, 1e-10);
}

TEST(ColorQuantity, AnUnknownNameListsTheKnownOnes)
{
  try
  {
    msi::colorQuantityNamed("HSV");
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(
      error.what(), "there is no color quantity 'HSV'; expected one of xyY, Luv, LCh, whiteness");
  }
}

// Bradford: the test suite of colour-science. CAT16: numpy with the matrix of the publication.
TEST(ChromaticAdaptation, MatricesAreThoseOfIndependentPrograms)
{
  const Vector3d a(1.09846607, 1.00000000, 0.35582280);
  const Vector3d d65(0.95042855, 1.00000000, 1.08890037);
  Eigen::Matrix3d bradford;
  bradford << 0.84467949, -0.11793553, 0.39489408, -0.13664085, 1.10412369, 0.12919812, 0.07986716,
    -0.13493155, 3.19288296;
  Eigen::Matrix3d cat16;
  cat16 << 0.950684478, -0.187391511, 0.262842680, -0.0256675063, 1.03230904, -0.0115623640,
    -0.00274132333, 0.0909859178, 2.81298923;
  const auto of = [&](const char* name)
  { return msi::adaptationMatrix(msi::chromaticAdaptationNamed(name), a, d65); };
  EXPECT_LT((of("Bradford") - bradford).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT((of("CAT16") - cat16).cwiseAbs().maxCoeff(), 1e-8);
  for (const auto& name : msi::chromaticAdaptationNames())
  {
    EXPECT_LT((of(name.c_str()) * a - d65).cwiseAbs().maxCoeff(), 1e-12) << name;
  }
  EXPECT_THROW(of("CAT02"), std::invalid_argument);
}

}

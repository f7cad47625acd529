#include "Kernels/Spectra/PossibleValues.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace
{

Eigen::MatrixXd filled(double value)
{
  return Eigen::MatrixXd::Constant(4, 10, value);
}

bool isPossibleReflectance(double value)
{
  Eigen::MatrixXd matrix = filled(0.4);
  matrix(2, 3) = value;
  return !msi::findImpossibleReflectance(matrix);
}

bool isPossibleResponse(double value, double others)
{
  Eigen::MatrixXd matrix = filled(others);
  matrix(2, 3) = value;
  return !msi::findImpossibleResponse(matrix);
}

TEST(PossibleValues, OfReflectance)
{
  for (const double value : { -1e9, -9999.0, -1.5, 101.0, 9999.0, 1e30 })
  {
    EXPECT_FALSE(isPossibleReflectance(value)) << value;
  }
  // Noise about zero, fluorescence, a mirror in the specular angle; NaN has checks of its own.
  for (const double value : { -0.02, 0.0, 1.0, 1.9, 30.0, std::nan("") })
  {
    EXPECT_TRUE(isPossibleReflectance(value)) << value;
  }
}

TEST(PossibleValues, OfResponsesRelativeToWhite)
{
  for (const double value : { -1e30, -9999.0, -999.0, -32768.0, -11.0, 1001.0, 65535.0, 1e30 })
  {
    EXPECT_FALSE(isPossibleResponse(value, 0.3)) << value;
  }
  for (const double value : { -0.01, 0.0, 1.0, 1.7, std::nan("") })
  {
    EXPECT_TRUE(isPossibleResponse(value, 0.3)) << value;
  }
}

TEST(PossibleValues, OfCounts)
{
  EXPECT_TRUE(isPossibleResponse(65535.0, 3000.0));
  EXPECT_TRUE(isPossibleResponse(-40.0, 3000.0));
  EXPECT_FALSE(isPossibleResponse(-9999.0, 3000.0));
  EXPECT_FALSE(isPossibleResponse(1e30, 3000.0));
}

TEST(PossibleValues, TheNoiseOfADarkFrameIsPossible)
{
  Eigen::MatrixXd counts(2, 3);
  counts << -3, 2, -1, 0, 4, -2;
  EXPECT_FALSE(msi::findImpossibleResponse(counts));
  EXPECT_FALSE(msi::findImpossibleResponse(counts * 1e-4));
  EXPECT_FALSE(msi::findImpossibleResponse(Eigen::MatrixXd::Zero(2, 3)));
  EXPECT_FALSE(msi::findImpossibleResponse(Eigen::MatrixXd(0, 0)));
}

TEST(PossibleValues, TheFirstOneIsNamed)
{
  Eigen::MatrixXd matrix = filled(0.4);
  matrix(3, 6) = -9999.0;
  matrix(1, 8) = -9999.0;
  const auto found = msi::findImpossibleReflectance(matrix);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->row, 3);
  EXPECT_EQ(found->column, 6);
  EXPECT_EQ(found->value, -9999.0);
  try
  {
    msi::requirePossibleReflectance(matrix, "calibration");
    FAIL() << "nothing was thrown";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_EQ(std::string(error.what()),
      "calibration sample 7, reflectance band 4 is -9999; expected -1 to 100, where 1 is the "
      "perfect white; "
      "remove the sample if this marks a missing value");
  }
}

}

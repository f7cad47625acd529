#include "Kernels/Camera/Effects/DetectorKernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace
{
// Over the range of a detector, with an odd count so that there is a remainder.
std::vector<double> signals()
{
  std::vector<double> values;
  for (int i = 0; i < 1013; ++i)
  {
    values.push_back(std::pow(10.0, -8.0 + 0.009 * i));
  }
  return values;
}

double allowed(double exponent, double value)
{
  return 1e-14 * (1.0 + std::fabs(exponent * std::log(value)));
}

TEST(DetectorKernel, RaisesAsTheStandardLibraryDoes)
{
  for (const double exponent : { 0.4, 1.0, 2.5, -3.0 })
  {
    std::vector<double> values = signals();
    msi::raise(exponent, values.data(), values.size());
    const std::vector<double> u = signals();
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      const double expected = std::pow(u[i], exponent);
      ASSERT_NEAR(values[i] / expected, 1.0, allowed(exponent, u[i])) << u[i] << "^" << exponent;
    }
  }
}

TEST(DetectorKernel, SaturatesByTheFormula)
{
  for (const double sharpness : { 2.0, 10.0, 60.0 })
  {
    std::vector<double> values = signals();
    msi::saturateGradually(0.8, sharpness, values.data(), values.size());
    const std::vector<double> u = signals();
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      const double over = std::pow(u[i] / 0.8, sharpness);
      const double expected = u[i] / std::pow(1.0 + over, 1.0 / sharpness);
      ASSERT_NEAR(values[i] / expected, 1.0, allowed(sharpness, u[i] / 0.8)) << u[i];
    }
  }
}

TEST(DetectorKernel, LeavesWhatIsNotAboveZero)
{
  std::vector<double> values{ -0.5, 0.0, std::numeric_limits<double>::quiet_NaN() };
  msi::raise(1.3, values.data(), values.size());
  msi::saturateGradually(0.8, 10.0, values.data(), values.size());
  EXPECT_EQ(values[0], -0.5);
  EXPECT_EQ(values[1], 0.0);
  EXPECT_TRUE(std::isnan(values[2]));
}

TEST(DetectorKernel, AValuesBytesDependOnNoOther)
{
  std::vector<double> together = signals();
  msi::raise(1.7, together.data(), together.size());
  const std::vector<double> u = signals();
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    double alone = u[i];
    msi::raise(1.7, &alone, 1);
    ASSERT_EQ(alone, together[i]);
  }
}
}

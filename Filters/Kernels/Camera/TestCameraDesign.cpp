#include "Kernels/Camera/CameraDesign.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace
{

TEST(BandpassFilter, IsHalfAtHalfWidthForEveryOrder)
{
  for (const double order : { 1.0, 2.0, 4.0, 12.0 })
  {
    const msi::BandpassFilter filter{ 550.0, 30.0, order, 0.8, 0.02 };
    EXPECT_NEAR(msi::transmittance(filter, 550.0), 0.8, 1e-15);
    EXPECT_NEAR(msi::transmittance(filter, 565.0), 0.41, 1e-15);
    EXPECT_NEAR(msi::transmittance(filter, 535.0), 0.41, 1e-15);
    EXPECT_NEAR(msi::transmittance(filter, 900.0), 0.02, 1e-6);
  }
}

TEST(BandpassFilter, OrderTwoIsAGaussian)
{
  const msi::BandpassFilter filter{ 500.0, 20.0, 2.0, 1.0, 0.0 };
  const double sigma = 20.0 / (2.0 * std::sqrt(2.0 * std::log(2.0)));
  for (const double wavelength : { 480.0, 493.0, 511.0 })
  {
    const double t = (wavelength - 500.0) / sigma;
    EXPECT_NEAR(msi::transmittance(filter, wavelength), std::exp(-0.5 * t * t), 1e-14);
  }
}

// CIE illuminant A is Planck's law at 2848 K with c2 = 1.435e-2 m K, so at 2848 x 1.438776877 / 1.435 K with today's.
TEST(PlanckianLight, IsIlluminantAAtItsTemperature)
{
  std::ifstream file(MULTISPECTRAL_SOURCE_DIR "/Data/Tables/illuminant_A.csv");
  ASSERT_TRUE(file);
  std::string line;
  std::getline(file, line);
  int compared = 0;
  while (std::getline(file, line))
  {
    std::istringstream cells(line);
    double wavelength = 0.0;
    double power = 0.0;
    char comma = 0;
    cells >> wavelength >> comma >> power;
    const Eigen::VectorXd light =
      msi::planckianLight(msi::WavelengthGrid({ wavelength }), 2848.0 * 1.438776877 / 1.435);
    EXPECT_NEAR(100.0 * light[0], power, 1e-5 * power) << wavelength;
    ++compared;
  }
  EXPECT_GT(compared, 80);
}

TEST(PlanckianLight, RefusesATemperatureOfZero)
{
  EXPECT_THROW(msi::planckianLight(msi::WavelengthGrid({ 550.0 }), 0.0), std::invalid_argument);
}

TEST(SiliconDetector, FollowsTheAbsorptionLaw)
{
  // 500 and 800 nm are nodes of the table: 11100 and 850 per cm.
  const msi::WavelengthGrid grid({ 500.0, 800.0 });
  const Eigen::VectorXd curve = msi::siliconDetector(grid, 5.0, 0.1);
  const double blue = 500.0 * std::exp(-1.11 * 0.1) * (1.0 - std::exp(-1.11 * 5.0));
  const double red = 800.0 * std::exp(-0.085 * 0.1) * (1.0 - std::exp(-0.085 * 5.0));
  EXPECT_NEAR(curve[0] / curve[1], blue / red, 1e-12);
  EXPECT_EQ(curve.maxCoeff(), 1.0);
}

TEST(SiliconDetector, RefusesAGridBeyondItsTable)
{
  EXPECT_THROW(msi::siliconDetector(msi::WavelengthGrid({ 350.0, 400.0 })), std::invalid_argument);
}

TEST(CameraDesign, GivesOneForAPerfectWhiteWhateverTheParts)
{
  const auto grid = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);
  msi::CameraParts parts;
  parts.light = msi::planckianLight(grid, 2900.0);
  parts.detector = msi::siliconDetector(grid);
  parts.filters = { { 450.0, 20.0 }, { 550.0, 60.0, 10.0, 0.5, 0.01 } };
  const msi::CameraModel camera = msi::designCamera(grid, parts);
  EXPECT_NEAR(camera.whiteResponse()[0], 1.0, 1e-14);
  EXPECT_NEAR(camera.whiteResponse()[1], 1.0, 1e-14);
  EXPECT_EQ(camera.channels(), (std::vector<std::string>{ "450nm", "550nm" }));
  EXPECT_EQ(camera.dark(), Eigen::VectorXd::Zero(2));
}

// The integral of a linear reflectance under a symmetric filter, flat light: its value at the center.
TEST(CameraDesign, UnevenGridsIntegrateByTrapezoids)
{
  std::vector<double> wavelengths;
  for (double w = 500.0; w < 550.0; w += 1.0)
  {
    wavelengths.push_back(w);
  }
  for (double w = 550.0; w <= 600.0; w += 2.0)
  {
    wavelengths.push_back(w);
  }
  const msi::WavelengthGrid grid(wavelengths);
  msi::CameraParts parts;
  parts.light = Eigen::VectorXd::Ones(grid.size());
  parts.detector = Eigen::VectorXd::Ones(grid.size());
  parts.filters = { { 550.0, 20.0 } };
  const msi::CameraModel camera = msi::designCamera(grid, parts);
  const Eigen::VectorXd ramp = (grid.vector().array() - 500.0) / 100.0;
  // Where the step changes, Euler-Maclaurin leaves (2^2 - 1^2) / 12 x slope 0.01 / area 21.3.
  EXPECT_NEAR(camera.responsivity().row(0).dot(ramp), 0.5 - 0.0025 / 21.3, 1e-5);
}

TEST(CameraDesign, NamesThePartThatDoesNotFit)
{
  const auto grid = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);
  msi::CameraParts parts;
  parts.light = Eigen::VectorXd::Ones(31);
  parts.detector = Eigen::VectorXd::Ones(30);
  parts.filters = { { 550.0, 20.0 } };
  try
  {
    msi::designCamera(grid, parts);
    FAIL() << "expected std::invalid_argument";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(), "the camera's detector has 30 values, its wavelength grid 31");
  }
  parts.detector = Eigen::VectorXd::Ones(31);
  parts.filters.push_back({ 550.0, 0.0 });
  EXPECT_THROW(msi::designCamera(grid, parts), std::invalid_argument);
}

}

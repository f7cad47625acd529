#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{

msi::WavelengthGrid threeBands()
{
  return msi::WavelengthGrid({ 400.0, 500.0, 600.0 });
}

msi::CameraModel camera()
{
  Eigen::MatrixXd responsivity(2, 3);
  responsivity << 1.0, 2.0, 0.0, 0.0, 0.5, 0.25;
  return { threeBands(), responsivity, Eigen::Vector2d(0.1, -0.2) };
}

using msi::test::messageOf;

TEST(CameraModel, NamesItsChannelsWhereNoneAreGiven)
{
  EXPECT_EQ(camera().channels(), (std::vector<std::string>{ "C1", "C2" }));
}

TEST(CameraModel, RefusesShapesThatDisagreeAndNamesBoth)
{
  const Eigen::MatrixXd responsivity = Eigen::MatrixXd::Ones(2, 4);
  EXPECT_EQ(
    messageOf([&] { msi::CameraModel(threeBands(), responsivity, Eigen::Vector2d::Zero()); }),
    "the camera's responsivity has 4 wavelengths, its grid 3");
  EXPECT_EQ(
    messageOf([&]
      { msi::CameraModel(threeBands(), Eigen::MatrixXd::Ones(2, 3), Eigen::Vector3d::Zero()); }),
    "the camera has 2 channels but 3 dark responses");
  EXPECT_EQ(messageOf(
              [&] {
                msi::CameraModel(
                  threeBands(), Eigen::MatrixXd::Ones(2, 3), Eigen::Vector2d::Zero(), { "a" });
              }),
    "the camera has 2 channels but 1 channel names");
  EXPECT_EQ(
    messageOf([&] { msi::CameraModel(threeBands(), Eigen::MatrixXd(0, 3), Eigen::VectorXd()); }),
    "a camera needs at least one channel");
}

TEST(CameraModel, RefusesWhatIsNotFiniteAndSaysWhere)
{
  Eigen::MatrixXd responsivity = Eigen::MatrixXd::Ones(1, 3);
  responsivity(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
    messageOf(
      [&] { msi::CameraModel(threeBands(), responsivity, Eigen::VectorXd::Zero(1), { "500nm" }); }),
    "the responsivity of channel 500nm at 500 nm is nan; expected a finite number");
}

TEST(CameraModel, WhiteBalanceGivesOneForAPerfectWhite)
{
  const msi::CameraModel balanced = camera().whiteBalanced();
  EXPECT_NEAR(balanced.whiteResponse()[0], 1.0, 1e-15);
  EXPECT_NEAR(balanced.whiteResponse()[1], 1.0, 1e-15);
  EXPECT_NEAR(balanced.dark()[0], 0.1 / 3.0, 1e-15);
  EXPECT_NEAR(balanced.dark()[1], -0.2 / 0.75, 1e-15);
}

TEST(CameraModel, WhiteBalanceRefusesABlindChannel)
{
  Eigen::MatrixXd responsivity = Eigen::MatrixXd::Zero(1, 3);
  const msi::CameraModel blind(threeBands(), responsivity, Eigen::VectorXd::Zero(1));
  EXPECT_EQ(messageOf([&] { blind.whiteBalanced(); }),
    "channel C1 answers a perfect white with 0; a white balance needs a value above zero");
}

TEST(CameraModel, CentroidIsTheWeightedMeanWavelength)
{
  EXPECT_NEAR(camera().centroids()[0], (400.0 + 2.0 * 500.0) / 3.0, 1e-12);
  EXPECT_NEAR(camera().centroids()[1], (0.5 * 500.0 + 0.25 * 600.0) / 0.75, 1e-12);
}

TEST(CameraModel, ResampledOnItsOwnGridItIsTheSame)
{
  const msi::CameraModel seven = msi::test::sevenChannels();
  EXPECT_EQ(resampled(seven, msi::test::visibleGrid()).responsivity(), seven.responsivity());
}

// Sprague's interpolation is exact for straight lines, and beyond the ends no line is asked for here.
TEST(CameraModel, ResampledItAnswersToAStraightLineAsBefore)
{
  const msi::CameraModel seven = msi::test::sevenChannels();
  for (const double step : { 5.0, 20.0 })
  {
    const auto grid = msi::WavelengthGrid::uniform(400.0, 700.0, step);
    const msi::CameraModel other = resampled(seven, grid);
    ASSERT_EQ(other.wavelengths(), grid);
    const auto line = [](const msi::WavelengthGrid& at)
    { return Eigen::VectorXd((at.vector().array() - 300.0) / 500.0); };
    const Eigen::VectorXd expected = seven.responsivity() * line(seven.wavelengths());
    EXPECT_LT((other.responsivity() * line(grid) - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((other.whiteResponse() - seven.whiteResponse()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(other.dark(), seven.dark());
    EXPECT_EQ(other.channels(), seven.channels());
  }
}

TEST(CameraResponse, IsTheSumOverWavelengthsPlusDark)
{
  Eigen::MatrixXd reflectance(3, 2);
  reflectance << 0.5, 0.0, 0.25, 1.0, 1.0, 0.5;
  const Eigen::MatrixXd response = msi::cameraResponse(camera())(reflectance);
  EXPECT_NEAR(response(0, 0), 0.5 + 2.0 * 0.25 + 0.1, 1e-15);
  EXPECT_NEAR(response(1, 0), 0.5 * 0.25 + 0.25 - 0.2, 1e-15);
  EXPECT_NEAR(response(0, 1), 2.0 + 0.1, 1e-15);
  EXPECT_NEAR(response(1, 1), 0.5 + 0.125 - 0.2, 1e-15);
}

TEST(CameraResponse, AgreesWithAnIndependentSumToTwelveDigits)
{
  const auto grid = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);
  Eigen::MatrixXd responsivity(16, 31);
  for (Eigen::Index k = 0; k < 16; ++k)
  {
    for (Eigen::Index j = 0; j < 31; ++j)
    {
      responsivity(k, j) = std::exp(-0.01 * std::pow(grid[j] - 400.0 - 20.0 * double(k), 2));
    }
  }
  const Eigen::VectorXd dark = Eigen::VectorXd::LinSpaced(16, 0.0, 0.03);
  Eigen::MatrixXd reflectance(31, 7);
  for (Eigen::Index s = 0; s < 7; ++s)
  {
    for (Eigen::Index j = 0; j < 31; ++j)
    {
      reflectance(j, s) = 0.5 + 0.4 * std::sin(0.1 * double(s + 1) * double(j));
    }
  }
  const auto respond = msi::cameraResponse(msi::CameraModel(grid, responsivity, dark));
  const Eigen::MatrixXd response = respond(reflectance);
  const Eigen::MatrixXf reflectanceFloat = reflectance.cast<float>();
  Eigen::MatrixXf responseFloat(16, 7);
  respond.apply(reflectanceFloat.data(), responseFloat.data(), 7);
  for (Eigen::Index s = 0; s < 7; ++s)
  {
    for (Eigen::Index k = 0; k < 16; ++k)
    {
      long double sum = dark[k];
      for (Eigen::Index j = 0; j < 31; ++j)
      {
        sum += static_cast<long double>(responsivity(k, j)) * reflectance(j, s);
      }
      EXPECT_NEAR(response(k, s), static_cast<double>(sum), 1e-12);
      EXPECT_NEAR(double(responseFloat(k, s)), static_cast<double>(sum), 2e-6);
    }
  }
}

TEST(CameraResponse, NaNStaysInItsOwnPixel)
{
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(3, 5, 0.5);
  const auto respond = msi::cameraResponse(camera());
  const Eigen::MatrixXd clean = respond(reflectance);
  reflectance(1, 2) = std::numeric_limits<double>::quiet_NaN();
  const Eigen::MatrixXd response = respond(reflectance);
  for (Eigen::Index s = 0; s < 5; ++s)
  {
    if (s == 2)
    {
      EXPECT_TRUE(std::isnan(response(0, s)));
    }
    else
    {
      EXPECT_EQ(response.col(s), clean.col(s));
    }
  }
}

}

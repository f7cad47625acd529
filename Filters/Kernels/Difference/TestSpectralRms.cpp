#include "Kernels/Difference/CIE76.h"
#include "Kernels/Difference/SpectralMetric.h"
#include "Kernels/Difference/SpectralRms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd rms(const MatrixXd& measured, const MatrixXd& estimated)
{
  VectorXd result(measured.cols());
  msi::spectralRms(measured, estimated, result);
  return result;
}

// Differences 1, 2, .., 7 hundredths: their squares sum to 140e-4, the values to 28e-2.
MatrixXd ramp()
{
  return VectorXd::LinSpaced(7, 0.01, 0.07);
}

TEST(SpectralRms, AnalyticCase)
{
  const MatrixXd measured = MatrixXd::Constant(7, 1, 0.5);
  EXPECT_NEAR(rms(measured, measured + ramp())(0), std::sqrt(20e-4), 1e-15);
  EXPECT_NEAR(rms(measured + ramp(), measured)(0), std::sqrt(20e-4), 1e-15);
  EXPECT_EQ(rms(measured, measured)(0), 0.0);
  VectorXd mean(1);
  msi::spectralMeanAbsoluteError(measured, measured - ramp(), mean);
  EXPECT_NEAR(mean(0), 0.04, 1e-15);
}

TEST(SpectralRms, GoodnessOfFitIsTheCosineOfTheSpectra)
{
  MatrixXd measured(2, 4);
  measured << 1, 1, 1, 0, 0, 1, 0, 0;
  MatrixXd estimated(2, 4);
  estimated << 3, 1, 0, 1, 0, 0, 2, 1;
  VectorXd got(4);
  msi::goodnessOfFit(measured, estimated, got);
  EXPECT_DOUBLE_EQ(got(0), 1.0);
  EXPECT_DOUBLE_EQ(got(1), std::sqrt(0.5));
  EXPECT_EQ(got(2), 0.0);
  EXPECT_TRUE(std::isnan(got(3)));
}

TEST(SpectralRms, TheSpectralAngleIsThatBetweenVectors)
{
  MatrixXd measured = MatrixXd::Zero(5, 4);
  MatrixXd estimated = MatrixXd::Zero(5, 4);
  measured.col(0) << 0.1, 0.2, 0.3, 0.4, 0.5;
  estimated.col(0) = 3.0 * measured.col(0);
  measured(1, 1) = 0.5;
  estimated.col(1) << 0.0, 0.7, 0.0, 0.7, 0.0; // 45 degrees
  measured(0, 2) = 1.0;
  estimated(0, 2) = 1.0;
  estimated(4, 2) = 1e-9; // arccos of the cosine would give 0
  VectorXd got(4);
  msi::findSpectralMetric("sam")->apply(measured, estimated, got);
  EXPECT_NEAR(got(0), 0.0, 1e-15);
  EXPECT_NEAR(got(1), std::acos(-1.0) / 4.0, 1e-15);
  EXPECT_NEAR(got(2), 1e-9, 1e-18);
  EXPECT_TRUE(std::isnan(got(3)));
  EXPECT_EQ(msi::findSpectralMetric("rmse"), nullptr);
}

TEST(SpectralRms, TheSameBytesForEverySplitAndAlignment)
{
  const MatrixXd measured = MatrixXd::Random(31, 40);
  const MatrixXd estimated = MatrixXd::Random(31, 40);
  const VectorXd whole = rms(measured, estimated);
  MatrixXd shifted(32, 40);
  shifted.bottomRows(31) = measured;
  EXPECT_EQ(rms(shifted.bottomRows(31), estimated), whole);
  VectorXd pieces(40);
  for (Eigen::Index i = 0; i < 40; ++i)
  {
    msi::spectralRms(measured.col(i), estimated.col(i), pieces.segment(i, 1));
  }
  EXPECT_EQ(pieces, whole);
}

TEST(SpectralRms, FloatBlocksAreSummedInDouble)
{
  const Eigen::MatrixXf measured = Eigen::MatrixXf::Random(31, 20);
  const Eigen::MatrixXf estimated = Eigen::MatrixXf::Random(31, 20);
  Eigen::VectorXf got(20);
  msi::spectralRms(measured, estimated, got);
  EXPECT_EQ(got, rms(measured.cast<double>(), estimated.cast<double>()).cast<float>());
}

TEST(SpectralRms, ANaNStaysInItsOwnSample)
{
  MatrixXd measured = MatrixXd::Random(31, 5);
  const MatrixXd estimated = MatrixXd::Random(31, 5);
  const VectorXd clean = rms(measured, estimated);
  measured(30, 2) = std::numeric_limits<double>::quiet_NaN();
  const VectorXd got = rms(measured, estimated);
  EXPECT_TRUE(std::isnan(got(2)));
  EXPECT_EQ(got.head(2), clean.head(2));
  EXPECT_EQ(got.tail(2), clean.tail(2));
}

TEST(CIE76, IsTheEuclideanDistance)
{
  EXPECT_EQ(msi::deltaE76({ 50.0, 1.0, 2.0 }, { 52.0, -2.0, 8.0 }), 7.0);
  Eigen::Matrix3Xf first(3, 3);
  first << 50, 50, 1, 1, 2, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0;
  Eigen::Matrix3Xf second = first;
  second(0, 1) = 53.0F;
  Eigen::VectorXf got(3);
  msi::deltaE76(first, second, got);
  EXPECT_EQ(got(0), 0.0F);
  EXPECT_EQ(got(1), 3.0F);
  EXPECT_TRUE(std::isnan(got(2)));
}

}

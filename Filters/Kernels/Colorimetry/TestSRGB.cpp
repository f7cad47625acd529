#include "Kernels/Colorimetry/SRGB.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using msi::SRGB;

const Vector3d D65(100.0 * 0.3127 / 0.3290, 100.0, 100.0 * 0.3583 / 0.3290);
const Vector3d D50(96.42, 100.0, 82.49);

Vector3d rgbOf(const SRGB& srgb, const Vector3d& xyz, msi::SRGBClipping* clipping = nullptr)
{
  Eigen::Matrix3Xd rgb(3, 1);
  const msi::SRGBClipping found = srgb.apply(xyz, rgb);
  if (clipping != nullptr)
  {
    *clipping = found;
  }
  return rgb.col(0);
}

// IEC 61966-2-1:1999 prints the matrix to four decimals.
TEST(SRGB, MatrixIsThatOfTheStandard)
{
  Matrix3d printed;
  printed << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  EXPECT_LT((100.0 * SRGB(D65).linearMatrix() - printed).cwiseAbs().maxCoeff(), 5e-4);
}

// The matrix that CSS Color 4 states for Display P3.
TEST(SRGB, DisplayP3IsThatOfCSS)
{
  Matrix3d published;
  published << 2.4934969119, -0.9313836179, -0.4027107845, -0.8294889696, 1.7626640603,
    0.0236246858, 0.0358458302, -0.0761723893, 0.9568845240;
  const SRGB p3(D65, msi::displaySpaceNamed("Display P3"));
  EXPECT_LT((100.0 * p3.linearMatrix() - published).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_THROW(msi::displaySpaceNamed("Rec. 2020"), std::invalid_argument);
}

TEST(SRGB, ThePrimariesOfDisplayP3AreOutOfTheGamutOfSRGB)
{
  const SRGB p3(D65, msi::DisplaySpace::DisplayP3);
  const SRGB srgb(D65);
  const Matrix3d primaries = p3.linearMatrix().inverse();
  for (Eigen::Index i = 0; i < 3; ++i)
  {
    const Vector3d xyz = 0.9 * primaries.col(i);
    EXPECT_FALSE(p3.isOutOfGamut(xyz));
    EXPECT_EQ(srgb.isOutOfGamut(xyz), i < 2); // their blues are one
    msi::SRGBClipping clipping;
    rgbOf(srgb, xyz, &clipping);
    EXPECT_EQ(clipping.outOfGamut, i < 2 ? 1 : 0);
  }
  EXPECT_FALSE(srgb.isOutOfGamut(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())));
}

// Bruce Lindbloom's matrix from XYZ under D50 to sRGB, by Bradford; his D65 has slightly other digits.
TEST(SRGB, AdaptsByBradford)
{
  Matrix3d published;
  published << 3.1338561, -1.6168667, -0.4906146, -0.9787684, 1.9161415, 0.0334540, 0.0719453,
    -0.2289914, 1.4052427;
  const SRGB srgb(Vector3d(96.422, 100.0, 82.521));
  EXPECT_LT((100.0 * srgb.linearMatrix() - published).cwiseAbs().maxCoeff(), 5e-4);
}

TEST(SRGB, TheWhitePointIsWhiteAndGraysAreGray)
{
  for (const Vector3d& white : { D65, D50, Vector3d(109.85, 100.0, 35.585) })
  {
    const SRGB srgb(white);
    msi::SRGBClipping clipping;
    EXPECT_LT((rgbOf(srgb, white, &clipping) - Vector3d::Ones()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(clipping.outOfGamut, 0);
    const Vector3d gray = rgbOf(srgb, 0.18 * white);
    EXPECT_LT((gray.array() - SRGB::encode(0.18)).abs().maxCoeff(), 1e-12);
  }
}

// 0.5 encoded is 0.21404114 linear; the two pieces meet at 0.0031308.
TEST(SRGB, TransferFunctionIsThatOfTheStandard)
{
  EXPECT_NEAR(SRGB::decode(0.5), 0.21404114, 5e-9);
  EXPECT_DOUBLE_EQ(SRGB::encode(0.001), 0.01292);
  EXPECT_DOUBLE_EQ(SRGB::encode(1.0), 1.0);
  for (const double value : { 0.0, 0.002, 0.04, 0.05, 0.3, 0.9, 1.0 })
  {
    EXPECT_NEAR(SRGB::decode(SRGB::encode(value)), value, 1e-12);
  }
}

TEST(SRGB, BlocksFollowTheTransferFunction)
{
  const SRGB srgb(D65);
  const Matrix3d toXYZ = srgb.linearMatrix().inverse();
  Eigen::Matrix3Xd linear = (Eigen::Matrix3Xd::Random(3, 10'001).array() + 1.0) / 2.0;
  linear.leftCols(2'000) *= 0.01;
  Eigen::Matrix3Xd got(3, linear.cols());
  const auto clipping = srgb.apply(toXYZ * linear, got);
  EXPECT_EQ(clipping.outOfGamut, 0);
  const Eigen::Matrix3Xd expected = linear.unaryExpr([](double x) { return SRGB::encode(x); });
  EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SRGB, ClippingIsCounted)
{
  const SRGB srgb(D65);
  Eigen::Matrix3Xd xyz(3, 11);
  xyz.colwise() = 0.5 * D65;
  xyz.col(2) = 1.1 * D65;                  // too bright
  xyz.col(4) = Vector3d(10.0, 40.0, 20.0); // too green
  xyz.col(5) = -0.01 * D65;                // below black
  xyz.col(6) = (1.0 + 1e-8) * D65;         // white but for rounding
  xyz(1, 9) = std::numeric_limits<double>::infinity();
  xyz(2, 10) = std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3Xd rgb(3, 11);
  auto clipping = srgb.apply(xyz, rgb);
  EXPECT_EQ(clipping.outOfGamut, 3);
  EXPECT_EQ(clipping.notFinite, 2);
  EXPECT_LE(rgb.leftCols(9).maxCoeff(), 1.0);
  EXPECT_GE(rgb.leftCols(9).minCoeff(), 0.0);
  EXPECT_TRUE(rgb.rightCols(2).array().isNaN().all());
  EXPECT_TRUE(rgb.leftCols(9).allFinite());
  clipping += clipping;
  EXPECT_EQ(clipping.outOfGamut, 6);

  Eigen::Matrix3Xf rgbFloat(3, 11);
  const auto clippingFloat = srgb.apply(xyz.cast<float>().eval(), rgbFloat);
  EXPECT_EQ(clippingFloat.outOfGamut, 3);
  EXPECT_EQ(clippingFloat.notFinite, 2);
  EXPECT_LT((rgbFloat.leftCols(9).cast<double>() - rgb.leftCols(9)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SRGB, TheSameBytesForEverySplitAndStride)
{
  const SRGB srgb(D50);
  const Eigen::Matrix3Xd xyz = 60.0 * (Eigen::Matrix3Xd::Random(3, 59).array() + 1.0);
  Eigen::Matrix3Xd whole(3, 59);
  const auto clipping = srgb.apply(xyz, whole);
  Eigen::MatrixXd pieces(4, 59);
  auto sum = srgb.apply(xyz.leftCols(13), pieces.block<3, 13>(0, 0));
  sum += srgb.apply(xyz.rightCols(46), pieces.block<3, 46>(0, 13));
  EXPECT_EQ(pieces.topRows<3>(), whole);
  EXPECT_EQ(sum.outOfGamut, clipping.outOfGamut);
}

TEST(SRGB, RefusesAWhitePointThatIsNone)
{
  EXPECT_THROW(SRGB(Vector3d(0.0, 100.0, 100.0)), std::invalid_argument);
}

}

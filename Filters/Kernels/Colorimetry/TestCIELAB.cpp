#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/ColorBlocks.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>

namespace
{

using Eigen::Vector3d;
using msi::CIELAB;

const Vector3d WhiteD65(95.047, 100.0, 108.883);

// L*a*b* by the definition, with the library's cube root.
Vector3d definition(const Vector3d& xyz, const Vector3d& white)
{
  const auto f = [](double t)
  { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
  const Vector3d ratio = xyz.array() / white.array();
  return { 116.0 * f(ratio(1)) - 16.0, 500.0 * (f(ratio(0)) - f(ratio(1))),
    200.0 * (f(ratio(1)) - f(ratio(2))) };
}

Eigen::Matrix3Xd randomColors(Eigen::Index count)
{
  std::mt19937_64 random(1976);
  std::uniform_real_distribution<double> uniform(-0.05, 1.3);
  Eigen::Matrix3Xd xyz(3, count);
  for (double& value : xyz.reshaped())
  {
    // The cube crowds the dark end, where the two branches meet.
    value = 100.0 * std::pow(uniform(random), 3.0);
  }
  return xyz;
}

// The example that colour-science prints for XYZ_to_Lab, with its white of x 0.3127, y 0.3290.
TEST(CIELAB, MatchesColourScience)
{
  const CIELAB lab(Vector3d(0.3127 / 0.329, 1.0, 0.3583 / 0.329));
  const Vector3d got = lab.fromXYZ(Vector3d(0.20654008, 0.12197225, 0.05136952));
  EXPECT_LT((got - Vector3d(41.52787529, 52.63858304, 26.92317922)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(CIELAB, WhiteGrayAndBlack)
{
  const CIELAB lab(WhiteD65);
  EXPECT_LT((lab.fromXYZ(WhiteD65) - Vector3d(100.0, 0.0, 0.0)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(lab.fromXYZ(Vector3d::Zero()).cwiseAbs().maxCoeff(), 1e-12);
  // An eighth has the cube root one half: L* = 116 / 2 - 16.
  EXPECT_NEAR(lab.fromXYZ(WhiteD65 / 8.0)(0), 42.0, 1e-12);
}

TEST(CIELAB, BlocksFollowTheDefinition)
{
  const CIELAB lab(WhiteD65);
  const Eigen::Matrix3Xd xyz = randomColors(200'003);
  Eigen::Matrix3Xd got(3, xyz.cols());
  lab.fromXYZ(xyz, got);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < xyz.cols(); ++i)
  {
    worst = std::max(worst, (got.col(i) - definition(xyz.col(i), WhiteD65)).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-12);

  const Eigen::Matrix3Xf rounded = xyz.cast<float>();
  Eigen::Matrix3Xf gotFloat(3, xyz.cols());
  lab.fromXYZ(rounded, gotFloat);
  lab.fromXYZ(rounded.cast<double>(), got);
  EXPECT_EQ(gotFloat, got.cast<float>());
}

TEST(CIELAB, FloatStepsAreWithinTheBoundAndTheSameBytes)
{
  Eigen::Matrix3Xf xyz = randomColors(200'003).cast<float>();
  xyz.leftCols<1000>() *= 1e-3F; // about the end of the linear part
  xyz.col(1000).setZero();
  const auto inFloat = [](const Eigen::Matrix3Xf& colors)
  {
    Eigen::Matrix3Xf lab(3, colors.cols());
    msi::labFromXYZInFloat(
      WhiteD65.data(), colors.data(), lab.data(), static_cast<std::size_t>(colors.cols()));
    return lab;
  };
  const Eigen::Matrix3Xf got = inFloat(xyz);
  Eigen::Matrix3Xd expected(3, xyz.cols());
  CIELAB(WhiteD65).fromXYZ(xyz.cast<double>(), expected);
  // 2e-7 of each root, as ColorBlocks.h states, and a rounding of the result.
  const Eigen::Matrix3Xd error = (got.cast<double>() - expected).cwiseAbs();
  const Eigen::Array3Xd roots =
    (xyz.cast<double>().array().colwise() / WhiteD65.array()).max(0.01).pow(1.0 / 3.0);
  const Eigen::ArrayXXd rounding = 1.2e-7 * expected.array().abs() + 2e-6;
  const auto within = [&](Eigen::Index row, double factor, const Eigen::RowVectorXd& sum)
  { return (error.row(row).array() <= 2e-7 * factor * sum.array() + rounding.row(row)).all(); };
  EXPECT_TRUE(within(0, 116.0, roots.row(1)));
  EXPECT_TRUE(within(1, 500.0, roots.row(0) + roots.row(1)));
  EXPECT_TRUE(within(2, 200.0, roots.row(1) + roots.row(2)));

  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1)
  {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().DeInit();
    EXPECT_EQ(inFloat(xyz), got) << hwy::TargetName(rest & -rest);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  xyz(1, 7) = std::numeric_limits<float>::quiet_NaN();
  Eigen::Matrix3Xf withNaN = inFloat(xyz);
  EXPECT_TRUE(withNaN.col(7).array().isNaN().all()); // Y is part of all three
  withNaN.col(7) = got.col(7);
  EXPECT_EQ(withNaN, got);
}

TEST(CIELAB, ComesBack)
{
  const CIELAB lab(WhiteD65);
  const Eigen::Matrix3Xd xyz = randomColors(10'000);
  Eigen::Matrix3Xd there(3, xyz.cols());
  Eigen::Matrix3Xd back(3, xyz.cols());
  lab.fromXYZ(xyz, there);
  lab.toXYZ(there, back);
  EXPECT_LT((back - xyz).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(CIELAB, TheSameBytesForEverySplitStrideAndInPlace)
{
  const CIELAB lab(WhiteD65);
  const Eigen::Matrix3Xd xyz = randomColors(101);
  Eigen::Matrix3Xd whole(3, 101);
  lab.fromXYZ(xyz, whole);
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(4, 101);
  wide.bottomRows<3>() = xyz;
  lab.fromXYZ(wide.bottomRows<3>(), wide.bottomRows<3>());
  EXPECT_EQ(wide.bottomRows<3>(), whole);
  Eigen::Matrix3Xd pieces = xyz;
  lab.fromXYZ(pieces.leftCols(37), pieces.leftCols(37));
  lab.fromXYZ(pieces.rightCols(64), pieces.rightCols(64));
  EXPECT_EQ(pieces, whole);
  EXPECT_EQ(lab.fromXYZ(Vector3d(xyz.col(5))), whole.col(5));
}

TEST(CIELAB, ANaNStaysInItsOwnSample)
{
  const CIELAB lab(WhiteD65);
  Eigen::Matrix3Xd xyz = randomColors(20);
  Eigen::Matrix3Xd clean(3, 20);
  lab.fromXYZ(xyz, clean);
  xyz(1, 9) = std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3Xd got(3, 20);
  lab.fromXYZ(xyz, got);
  EXPECT_TRUE(got.col(9).array().isNaN().all());
  EXPECT_EQ(got.leftCols(9), clean.leftCols(9));
  EXPECT_EQ(got.rightCols(10), clean.rightCols(10));
}

TEST(CIELAB, LchGoesRound)
{
  EXPECT_LT(
    (msi::labToLch({ 50.0, 3.0, 4.0 }) - Vector3d(50.0, 5.0, 53.13010235415598)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(msi::labToLch({ 50.0, 0.0, -2.0 })(2), 270.0);
  EXPECT_EQ(msi::labToLch({ 50.0, 0.0, 0.0 })(2), 0.0);
  EXPECT_LT(msi::labToLch({ 50.0, 1.0, -1e-300 })(2), 360.0);
  const Vector3d lab(61.0, -20.0, 33.0);
  EXPECT_LT((msi::lchToLab(msi::labToLch(lab)) - lab).norm(), 1e-12);
}

TEST(CIELAB, RefusesAWhitePointThatIsNone)
{
  try
  {
    CIELAB lab(Vector3d(95.0, 100.0, 0.0));
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(
      error.what(), "the white point is 95, 100, 0; expected three finite values above zero");
  }
  EXPECT_THROW(CIELAB(Vector3d(95.0, std::nan(""), 100.0)), std::invalid_argument);
}

}

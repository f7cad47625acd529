// Color differences and conversions beside those of Little CMS, an independent program.
#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/SRGB.h"
#include "Kernels/Difference/CIEDE2000.h"

#include <gtest/gtest.h>
#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace
{

using Eigen::Vector3d;

class LittleCMS : public ::testing::Test
{
protected:
  Vector3d uniform(double low, double high)
  {
    std::uniform_real_distribution<double> distribution(low, high);
    return { distribution(Random), distribution(Random), distribution(Random) };
  }

  std::mt19937_64 Random{ 14 };
};

TEST_F(LittleCMS, CIEDE2000)
{
  const msi::CIEDE2000 difference({ 2.0, 1.0, 1.0 });
  double worst = 0.0;
  for (int i = 0; i < 200'000; ++i)
  {
    const Vector3d x = uniform(-100.0, 100.0).cwiseAbs().cwiseProduct(Vector3d(1, 0, 0)) +
      uniform(-120.0, 120.0).cwiseProduct(Vector3d(0, 1, 1));
    const Vector3d y = i % 2 == 0
      ? Vector3d(x + uniform(-3.0, 3.0))
      : Vector3d(uniform(0.0, 100.0)(0), -uniform(-120.0, 120.0)(0), uniform(-120.0, 120.0)(0));
    const cmsCIELab lab1{ x(0), x(1), x(2) };
    const cmsCIELab lab2{ y(0), y(1), y(2) };
    worst =
      std::max(worst, std::abs(difference(x, y) - cmsCIE2000DeltaE(&lab1, &lab2, 2.0, 1.0, 1.0)));
  }
  EXPECT_LT(worst, 1e-9);
}

TEST_F(LittleCMS, CIELAB)
{
  const Vector3d white(0.9642, 1.0, 0.8249);
  const cmsCIEXYZ cmsWhite{ white(0), white(1), white(2) };
  const msi::CIELAB lab(white);
  double worst = 0.0;
  for (int i = 0; i < 10'000; ++i)
  {
    const Vector3d xyz = uniform(0.0, 1.0).array().cube();
    const cmsCIEXYZ cmsXYZ{ xyz(0), xyz(1), xyz(2) };
    cmsCIELab expected;
    cmsXYZ2Lab(&cmsWhite, &expected, &cmsXYZ);
    const Vector3d got = lab.fromXYZ(xyz);
    worst =
      std::max(worst, (got - Vector3d(expected.L, expected.a, expected.b)).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-10);
}

// The profile connection space is relative to the ICC's D50; Little CMS adapts it by Bradford too.
TEST_F(LittleCMS, SRGB)
{
  using Profile = std::unique_ptr<void, decltype(&cmsCloseProfile)>;
  const Profile connection(cmsCreateXYZProfile(), &cmsCloseProfile);
  const Profile screen(cmsCreate_sRGBProfile(), &cmsCloseProfile);
  const std::unique_ptr<void, decltype(&cmsDeleteTransform)> transform(
    cmsCreateTransform(connection.get(), TYPE_XYZ_DBL, screen.get(), TYPE_RGB_DBL,
      INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE),
    &cmsDeleteTransform);
  ASSERT_NE(transform, nullptr);

  const msi::SRGB srgb(Vector3d(96.42, 100.0, 82.49));
  double worst = 0.0;
  for (int i = 0; i < 10'000; ++i)
  {
    // A color of the gamut: a mixture of white and the primaries, adapted to D50.
    const Vector3d share = uniform(0.01, 0.99);
    Eigen::Matrix3d primaries;
    primaries << 0.4361, 0.3851, 0.1431, 0.2225, 0.7169, 0.0606, 0.0139, 0.0971, 0.7141;
    const Vector3d xyz = primaries * share;
    const cmsCIEXYZ in{ xyz(0), xyz(1), xyz(2) };
    double expected[3];
    cmsDoTransform(transform.get(), &in, expected, 1);
    Eigen::Matrix3Xd got(3, 1);
    srgb.apply(Eigen::Matrix3Xd(100.0 * xyz), got);
    worst = std::max(
      worst, (got.col(0) - Vector3d(expected[0], expected[1], expected[2])).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-5);
  RecordProperty("worst", std::to_string(worst));
}

}

#include "Kernels/Sampling/ChartLayout.h"
#include "Kernels/Sampling/PatchQuality.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

constexpr int Side = 40;

struct Patch
{
  Eigen::MatrixXf pixels = Eigen::MatrixXf(2, Side* Side);
  Eigen::Matrix2Xd places = Eigen::Matrix2Xd(2, Side* Side);
  Eigen::VectorXf clipping = Eigen::VectorXf::Constant(2, 1.0F);

  Patch()
  {
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0.4F, 0.01F);
    for (int i = 0; i < Side * Side; ++i)
    {
      pixels.col(i) << noise(random), noise(random);
      places.col(i) << i % Side, i / Side;
    }
  }
  msi::PatchQuality quality() const { return msi::patchQuality(pixels, places, clipping); }
};

TEST(PatchQuality, NoiseIsNoDirt)
{
  const auto quality = Patch().quality();
  EXPECT_EQ(quality.clipped, 0.0);
  EXPECT_EQ(quality.outliers, 0.0);
  EXPECT_LT(quality.slope, 0.005);
}

TEST(PatchQuality, CountsClippedAndNaNPixels)
{
  Patch patch;
  patch.pixels.leftCols(160).row(1).setOnes();
  EXPECT_DOUBLE_EQ(patch.quality().clipped, 0.1);
  patch.pixels.leftCols(320).setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_DOUBLE_EQ(patch.quality().clipped, 0.2);
  patch.pixels.setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_DOUBLE_EQ(patch.quality().clipped, 1.0);
}

TEST(PatchQuality, CountsDust)
{
  Patch patch;
  patch.pixels.leftCols(80) *= 0.5F;
  EXPECT_DOUBLE_EQ(patch.quality().outliers, 0.05);
}

TEST(PatchQuality, SeesAShadow)
{
  Patch patch;
  patch.pixels.rightCols(Side * Side / 2) *= 0.8F; // 0.4 and 0.32 around 0.36
  EXPECT_NEAR(patch.quality().slope, 0.08 / 0.36, 0.005);
}

// The order of a chart of 3 x 2 patches, by columns: what ArgyllCMS writes.
TEST(ChartLayout, ReadsLettersAndNumbers)
{
  using Numbers = std::vector<int>;
  EXPECT_EQ(
    msi::patchNumbers({ "A1", "A2", "B1", "B2", "C1", "C2" }, 3, 2), (Numbers{ 1, 4, 2, 5, 3, 6 }));
  EXPECT_EQ(
    msi::patchNumbers({ "A1", "A2", "A3", "B1", "B2", "B3" }, 3, 2), (Numbers{ 1, 2, 3, 4, 5, 6 }));
  EXPECT_EQ(msi::patchNumbers({ "b02", "a02", "a01", "b01" }, 2, 2), (Numbers{ 4, 3, 1, 2 }));
  EXPECT_EQ(msi::patchNumbers({ "dark skin", "light skin", "blue sky", "foliage" }, 2, 2),
    (Numbers{ 1, 2, 3, 4 }));
  EXPECT_EQ(msi::patchNumbers({ "1", "2", "3", "4" }, 4, 1), (Numbers{ 1, 2, 3, 4 }));
  EXPECT_THROW(msi::patchNumbers({ "A1", "A2" }, 3, 2), std::invalid_argument);
}

}

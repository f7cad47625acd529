#include "Kernels/Colorimetry/SpectralPicture.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace
{

using Bytes = std::vector<unsigned char>;

std::vector<double> visible()
{
  std::vector<double> nm;
  for (int w = 400; w <= 700; w += 10)
  {
    nm.push_back(w);
  }
  return nm;
}

Bytes colorOf(const msi::SpectralPicture& picture, const std::vector<float>& pixel)
{
  Bytes rgb(3);
  picture.apply(pixel.data(), 1, rgb.data());
  return rgb;
}

// A gray of reflectance r is the sRGB gray of linear level r (IEC 61966-2-1), under any illuminant.
TEST(SpectralPicture, GraysAreGrays)
{
  const msi::SpectralPicture picture(31, visible());
  EXPECT_TRUE(picture.isColorimetric());
  EXPECT_EQ(colorOf(picture, std::vector<float>(31, 1.0F)), (Bytes{ 255, 255, 255 }));
  EXPECT_EQ(colorOf(picture, std::vector<float>(31, 0.0F)), (Bytes{ 0, 0, 0 }));
  EXPECT_EQ(colorOf(picture, std::vector<float>(31, 0.2158605F)), (Bytes{ 128, 128, 128 }));
}

TEST(SpectralPicture, WhiteIsTheLevelAskedFor)
{
  const msi::SpectralPicture picture(31, visible(), {}, 4095.0);
  EXPECT_EQ(colorOf(picture, std::vector<float>(31, 4095.0F)), (Bytes{ 255, 255, 255 }));
  const auto other = msi::SpectralPicture(31, visible()).withWhite(4095.0);
  EXPECT_EQ(colorOf(other, std::vector<float>(31, 4095.0F * 0.2158605F)), (Bytes{ 128, 128, 128 }));
}

TEST(SpectralPicture, NaNIsGrayAndStaysInItsPixel)
{
  const msi::SpectralPicture picture(31, visible());
  std::vector<float> pixels(93, 0.0F);
  pixels[31 + 7] = std::numeric_limits<float>::quiet_NaN();
  Bytes rgb(9);
  picture.apply(pixels.data(), 3, rgb.data());
  EXPECT_EQ(rgb, (Bytes{ 0, 0, 0, 128, 128, 128, 0, 0, 0 }));
}

TEST(SpectralPicture, OtherBandsAreShownAsTheyAre)
{
  const msi::SpectralPicture infrared(4, { 800, 900, 1000, 1100 });
  EXPECT_FALSE(infrared.isColorimetric());
  EXPECT_EQ(colorOf(infrared, { 1, 0, 0, 0 }), (Bytes{ 0, 0, 255 }));
  EXPECT_EQ(colorOf(infrared, { 0, 0, 0, 1 }), (Bytes{ 255, 0, 0 }));
  const msi::SpectralPicture asked(4, {}, { 1, 3, 0 });
  EXPECT_EQ(colorOf(asked, { 0, 1, 0, 0 }), (Bytes{ 255, 0, 0 }));
  const msi::SpectralPicture gray(1, {});
  EXPECT_EQ(colorOf(gray, { 1 }), (Bytes{ 255, 255, 255 }));
}

TEST(SpectralPicture, RefusesWhatIsNoPicture)
{
  EXPECT_THROW(msi::SpectralPicture(0, {}), std::invalid_argument);
  EXPECT_THROW(msi::SpectralPicture(3, { 400, 500 }), std::invalid_argument);
  EXPECT_THROW(msi::SpectralPicture(3, {}, { 3 }), std::invalid_argument);
  EXPECT_THROW(msi::SpectralPicture(3, {}, {}, 0.0), std::invalid_argument);
  EXPECT_THROW(msi::SpectralPicture(3, {}).withWhite(-1.0), std::invalid_argument);
}

}

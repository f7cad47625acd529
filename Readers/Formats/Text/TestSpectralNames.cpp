#include "Formats/Text/SpectralNames.h"

#include "Formats/Text/NumberText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using msi::fileNameWavelengths;
using msi::reflectanceColumnWavelength;
using msi::responseColumnNumber;

TEST(SpectralNames, OrdinaryWordsAreNoWavelengths)
{
  for (const char* name : { "sample", "x", "order", "R", "R1", "L400", "400a", "R400x", "R4 00", "",
         "nm", "RGB_R", "R-", "30000", "99", "R400-410", "SPEC_" })
  {
    EXPECT_FALSE(reflectanceColumnWavelength(name).has_value()) << name;
  }
  for (const char* name : { "C", "CMYK_C", "color", "C1a", "Cx", "R400", "c1.2.3" })
  {
    EXPECT_FALSE(responseColumnNumber(name).has_value()) << name;
  }
}

TEST(SpectralNames, BracketsAroundNumberOrUnit)
{
  for (const char* name : { "400[nm]", "400 (nm)", "R(400)", "R[400 nm]", "R (400)" })
  {
    EXPECT_EQ(reflectanceColumnWavelength(name), 400.0) << name;
  }
}

TEST(SpectralNames, WavelengthsOfFiles)
{
  for (const char* name : { "/data/2024/channel_450nm.tif", "0450nm.tif", "F450_nm.tif",
         "450 nm.tif", "scan12_450nm_2020.exr", "F450NM.tif" })
  {
    const auto found = fileNameWavelengths(name);
    ASSERT_EQ(found.size(), 1u) << name;
    EXPECT_EQ(found[0].nanometres, 450) << name;
    EXPECT_TRUE(found[0].hasUnit) << name;
  }
  for (const char* name : { "img_450.png", "450.tif", "IMG_0450.tif" })
  {
    const auto found = fileNameWavelengths(name);
    ASSERT_EQ(found.size(), 1u) << name;
    EXPECT_EQ(found[0].nanometres, 450) << name;
    EXPECT_FALSE(found[0].hasUnit) << name;
  }
  EXPECT_EQ(fileNameWavelengths("f_612.5nm.exr")[0].nanometres, 612.5);
  EXPECT_EQ(fileNameWavelengths("f_612,5nm.exr")[0].nanometres, 612.5);
  const auto several = fileNameWavelengths("scene_450_gain200.tif");
  ASSERT_EQ(several.size(), 2u);
  EXPECT_EQ(several[0].nanometres, 450);
  EXPECT_EQ(several[1].nanometres, 200);
  for (const char* name : { "channel_3.tif", "scene450x.tif", "red.tif", "450nmx.tif" })
  {
    EXPECT_TRUE(fileNameWavelengths(name).empty()) << name;
  }
}

TEST(SpectralNames, WavelengthsInTexts)
{
  EXPECT_EQ(msi::wavelengthInText("filter 3, 450.5 nm, 20 s"), 450.5);
  EXPECT_FALSE(msi::wavelengthInText("from 400nm to 700nm").has_value());
  EXPECT_FALSE(msi::wavelengthInText("450").has_value());
}

TEST(SpectralNames, NaturalOrder)
{
  EXPECT_TRUE(msi::naturalLess("img2", "img10"));
  EXPECT_FALSE(msi::naturalLess("img10", "img2"));
  EXPECT_TRUE(msi::naturalLess("a", "b"));
  EXPECT_TRUE(msi::naturalLess("img", "img1"));
  EXPECT_FALSE(msi::naturalLess("img1", "img1"));
  EXPECT_NE(msi::naturalLess("img01", "img1"), msi::naturalLess("img1", "img01"));
}

TEST(NumberText, ReadsOnlyWholeNumbersAndShortestTextsReadBack)
{
  EXPECT_EQ(msi::parseNumber(" +1.5e-3 "), 0.0015);
  EXPECT_EQ(msi::parseNumber("-1,5", true), -1.5);
  for (const char* text : { "", "+", "1,5", "1.5x", "0x10", "1 2", "--1", "+-1" })
  {
    EXPECT_FALSE(msi::parseNumber(text).has_value()) << text;
  }
  EXPECT_FALSE(msi::parseNumber("1.000,5", true).has_value());
  EXPECT_FALSE(msi::parseInteger("1.0").has_value());
  EXPECT_EQ(msi::numberText(0.1), "0.1");
  EXPECT_EQ(msi::numberText(0.1f), "0.1");
  for (const double value : { 1.0 / 3, 5e-324, std::numeric_limits<double>::max(), -0.0 })
  {
    EXPECT_EQ(msi::parseNumber(msi::numberText(value)), value);
  }
}

} // namespace

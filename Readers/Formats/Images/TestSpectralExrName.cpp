#include "Formats/Images/SpectralExrName.h"

#include <gtest/gtest.h>

namespace
{

using msi::parseSpectralExrName;

TEST(SpectralExrName, ReadsWavelengthsAndFrequencies)
{
  const auto reflective = parseSpectralExrName("T.400,500000nm");
  ASSERT_TRUE(reflective.has_value());
  EXPECT_EQ(reflective->kind, 'T');
  EXPECT_EQ(reflective->nanometres, 400.5);
  EXPECT_FALSE(reflective->reradiating);
  const auto emissive = parseSpectralExrName("S2.1,5um");
  ASSERT_TRUE(emissive.has_value());
  EXPECT_EQ(emissive->kind, 'S');
  EXPECT_EQ(emissive->stokes, 2);
  EXPECT_DOUBLE_EQ(emissive->nanometres, 1500.0);
  // 599.584916 THz is 500 nm: c = 299792458 m/s.
  EXPECT_DOUBLE_EQ(parseSpectralExrName("S0.599,584916THz")->nanometres, 500.0);
  EXPECT_DOUBLE_EQ(parseSpectralExrName("S0.4,0E2nm")->nanometres, 400.0);
  EXPECT_DOUBLE_EQ(parseSpectralExrName("T.4e-7m")->nanometres, 400.0);
}

TEST(SpectralExrName, KnowsFluorescence)
{
  const auto name = parseSpectralExrName("T.350,000000nm.450,000000nm");
  ASSERT_TRUE(name.has_value());
  EXPECT_TRUE(name->reradiating);
  EXPECT_EQ(name->nanometres, 350.0);
}

TEST(SpectralExrName, OtherNamesAreNone)
{
  for (const char* name :
    { "R", "G", "T", "T.", "T.nm", "T.400", "S4.400nm", "S0.400", "T.400xm", "T.-400nm", "T.0nm",
      "400nm", "T.400nm.", "T.400,0nm.x", "Y.400nm", "S0.inf nm", "T.nannm" })
  {
    EXPECT_FALSE(parseSpectralExrName(name).has_value()) << name;
  }
}

TEST(SpectralExrName, WritesWhatItReads)
{
  EXPECT_EQ(msi::spectralExrName('T', 400.0), "T.400nm");
  EXPECT_EQ(msi::spectralExrName('S', 400.25), "S0.400,25nm");
  EXPECT_EQ(parseSpectralExrName(msi::spectralExrName('T', 1234.5))->nanometres, 1234.5);
}

} // namespace

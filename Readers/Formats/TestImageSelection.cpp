#include "Formats/ImageSelection.h"

#include "Formats/FormatError.h"
#include "Formats/SpectralImageWriter.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace
{
using namespace msi;

constexpr int Width = 5;
constexpr int Height = 4;

// The value of band b at (x, y) is 100 b + 10 y + x.
class ImageSelectionTest : public ::testing::Test
{
protected:
  ImageSelectionTest()
    : Path((std::filesystem::temp_directory_path() / "multispectral-selection.img").string())
  {
    SpectralImageInfo info;
    info.width = Width;
    info.height = Height;
    info.bandNames = { "a", "b", "c", "d" };
    info.wavelengths = { 400.0, 450.0, 500.0, 550.0 };
    info.goodBands = { true, false, true, true };
    info.displayBands = { 3, 2, 0 };
    const auto writer = createEnviImage(Path, info);
    std::vector<float> row(Width * 4);
    for (int y = 0; y < Height; ++y)
    {
      for (int i = 0; i < Width * 4; ++i)
      {
        row[static_cast<std::size_t>(i)] = static_cast<float>(100 * (i % 4) + 10 * y + i / 4);
      }
      writer->writeRows(1, row.data());
    }
    writer->finish();
  }

  std::unique_ptr<SpectralImageFile> select(const ImageSelection& selection) const
  {
    return selectFrom(openSpectralImage(Path), selection, "cube");
  }

  static std::vector<float> valuesOf(const SpectralImageFile& file)
  {
    const auto& info = file.info();
    std::vector<float> values(
      static_cast<std::size_t>(info.width * info.height) * info.bandNames.size());
    file.readBlock({ 0, info.width, 0, info.height }, {}, values.data());
    return values;
  }

  std::string errorOf(const ImageSelection& selection) const
  {
    try
    {
      select(selection);
    }
    catch (const FormatError& error)
    {
      return error.what();
    }
    return {};
  }

  std::string Path;
};

TEST_F(ImageSelectionTest, TakesBandsARegionAndEveryNthPixel)
{
  ImageSelection selection;
  selection.bands = "4, 1 - 1";
  selection.region = { 1, 5, 0, 4 };
  selection.strideX = 3;
  selection.strideY = 2;
  const auto part = select(selection);
  EXPECT_EQ(part->info().wavelengths, (std::vector<double>{ 400.0, 550.0 }));
  EXPECT_EQ(valuesOf(*part), (std::vector<float>{ 1, 301, 4, 304, 21, 321, 24, 324 }));
  EXPECT_TRUE(part->info().displayBands.empty());
  EXPECT_EQ(part->info().notes.back(), "2 of 4 bands are read");
}

TEST_F(ImageSelectionTest, TakesARangeOfWavelengthsAndOnlyGoodBands)
{
  ImageSelection selection;
  selection.shortestWavelength = 450.0;
  selection.longestWavelength = 500.0;
  EXPECT_EQ(select(selection)->info().bandNames, (std::vector<std::string>{ "b", "c" }));
  selection.onlyGoodBands = true;
  EXPECT_EQ(select(selection)->info().bandNames, (std::vector<std::string>{ "c" }));
}

TEST_F(ImageSelectionTest, NamesWhatIsNotInTheFile)
{
  ImageSelection bands;
  bands.bands = "2-5";
  EXPECT_EQ(errorOf(bands),
    "cube: band 5 was asked for; expected bands from 1 to 4; correct the list of bands");
  bands.bands = "2-x";
  EXPECT_EQ(errorOf(bands),
    "cube: '2-x' in the list of bands '2-x' is no band or range of bands; expected band numbers "
    "from 1 on, such as "
    "1-16, 20; correct the list, or leave it empty for all bands");
  ImageSelection region;
  region.region = { 0, 6, 0, 1 };
  EXPECT_EQ(errorOf(region),
    "cube: the region of columns 0 to 5 and rows 0 to 0 was asked for; expected first and last "
    "column within 0 to 4, "
    "first and last row within 0 to 3; correct the region");
  ImageSelection range;
  range.shortestWavelength = 600.0;
  range.longestWavelength = 700.0;
  EXPECT_EQ(
    errorOf(range), "cube: no band lies in 600 to 700 nm; expected a part of 400 to 550 nm");
  ImageSelection stride;
  stride.strideX = 0;
  EXPECT_EQ(errorOf(stride), "cube: the stride is 0 x 1; expected whole numbers from 1 on");
}

TEST(SpectralImageNames, UnknownExtensionsAreRefused)
{
  SpectralImageInfo info;
  info.width = info.height = 1;
  info.bandNames = { "a" };
  try
  {
    createSpectralImage("/tmp/a.tif", info);
    FAIL() << "a.tif was created";
  }
  catch (const FormatError& error)
  {
    EXPECT_STREQ(error.what(),
      "/tmp/a.tif: has the extension '.tif', which no spectral image is written in; expected .exr "
      "(spectral OpenEXR) "
      "or .hdr, .img, .dat, .raw, .bin, .cube, .bsq, .bil, .bip (ENVI); choose one of these names");
  }
}
}

#include "Formats/SpectralImageFile.h"

#include "Formats/Images/TestImages.h"
#include "Formats/LabelImage.h"
#include "Support/formats/TestFiles.h"

#include <cstdint>
#include <limits>
#include <random>
#include <thread>

namespace
{

using msi::openSpectralImage;
using msi::SpectralImageOptions;
using msi::testing::writeImage;
using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint16_t>;
using Floats = std::vector<float>;
using Files = std::vector<std::string>;

Floats valuesOf(const msi::SpectralImageFile& file)
{
  const auto& info = file.info();
  Floats pixels(static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height) *
    static_cast<std::size_t>(info.bands()));
  file.readBlock({ 0, info.width, 0, info.height }, {}, pixels.data());
  return pixels;
}

class ImageStacks : public msi::testing::TemporaryFolder
{
protected:
  // 2 x 1 pixels of one float channel.
  std::string flat(const std::string& name, float a, float b) const
  {
    writeImage(path(name), 2, 1, 1, Floats{ a, b });
    return path(name);
  }
  std::string errorIn(const Files& files, const SpectralImageOptions& options = {}) const
  {
    return errorOf([&] { valuesOf(*openSpectralImage(files, options)); });
  }
};

TEST_F(ImageStacks, WavelengthsInFileNamesDecideTheOrder)
{
  const auto file = openSpectralImage(
    Files{ flat("c_700nm.tif", 5, 6), flat("c_450nm.tif", 1, 2), flat("c_1000nm.tif", 7, 8) });
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 450, 700, 1000 }));
  EXPECT_EQ(file->info().bandNames, (Files{ "c_450nm", "c_700nm", "c_1000nm" }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 1, 5, 7, 2, 6, 8 }));
  EXPECT_EQ(file->info().format, "TIFF");
  EXPECT_EQ(file->info().sampleType, "float32");
  EXPECT_EQ(file->info().notes, (Files{ "wavelengths are those in the file names" }));
}

TEST_F(ImageStacks, WrittenOverAfterOpening)
{
  flat("a.tif", 1, 2);
  setTime("a.tif", 1000000000);
  const auto file = openSpectralImage(Files{ path("a.tif") });
  EXPECT_EQ(valuesOf(*file), (Floats{ 1, 2 }));
  flat("b.tif", 3, 4);
  write("a.tif", read("b.tif")); // in place
  setTime("a.tif", 1000000001);
  EXPECT_EQ(errorOf([&] { valuesOf(*file); }),
    "a.tif: was written to while it was read; expected a file that stays as it is; wait until it "
    "is complete and read it again");
}

TEST_F(ImageStacks, ReplacedUnderItsNameStaysWhole)
{
  const auto file = openSpectralImage(Files{ flat("a.tif", 1, 2) });
  std::filesystem::rename(flat("b.tif", 3, 4), path("a.tif"));
  EXPECT_EQ(valuesOf(*file), (Floats{ 1, 2 }));
}

TEST_F(ImageStacks, NamesWithoutWavelengthsAreInNaturalOrder)
{
  const auto file =
    openSpectralImage(Files{ flat("c10.exr", 5, 6), flat("c9.exr", 1, 2), flat("c1.exr", 7, 8) });
  EXPECT_TRUE(file->info().wavelengths.empty());
  EXPECT_EQ(file->info().bandNames, (Files{ "c1", "c9", "c10" }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 7, 1, 5, 8, 2, 6 }));
}

TEST_F(ImageStacks, FrameNumbersAreNoWavelengths)
{
  const auto file = openSpectralImage(
    Files{ flat("img_0302.tif", 1, 1), flat("img_0301.tif", 0, 0), flat("img_0303.tif", 2, 2) });
  EXPECT_TRUE(file->info().wavelengths.empty());
  EXPECT_EQ(file->info().notes,
    (Files{ "the wavelengths are unknown: the numbers in the file names seem to count images" }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 0, 1, 2, 0, 1, 2 }));
}

TEST_F(ImageStacks, GivenWavelengthsCount)
{
  SpectralImageOptions options;
  options.wavelengths = { 600, 500 };
  const auto file =
    openSpectralImage(Files{ flat("a_400nm.tif", 1, 2), flat("b_450nm.tif", 3, 4) }, options);
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 500, 600 }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 3, 1, 4, 2 }));
  options.wavelengths = { 600 };
  EXPECT_EQ(errorIn({ path("a_400nm.tif"), path("b_450nm.tif") }, options),
    "a_400nm.tif: 1 wavelengths were given; expected 2, one for each band; complete the list");
}

TEST_F(ImageStacks, MetadataTellWavelengths)
{
  OIIO::ImageSpec spec(1, 1, 1, OIIO::TypeDesc::FLOAT);
  spec.attribute("ImageDescription", "filter 2: 650 nm");
  writeImage<float>(path("a.tif"), { spec }, { { 2.0f } });
  spec.attribute("ImageDescription", "filter 1: 450.5 nm");
  writeImage<float>(path("b.tif"), { spec }, { { 1.0f } });
  const auto file = openSpectralImage(Files{ path("a.tif"), path("b.tif") });
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 450.5, 650 }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 1, 2 }));
}

TEST_F(ImageStacks, IntegersAreScaledUnlessRaw)
{
  writeImage(path("a.png"), 3, 1, 1, Bytes{ 0, 51, 255 });
  writeImage(path("b.png"), 3, 1, 1, Words{ 0, 13107, 65535 });
  const Files files{ path("a.png"), path("b.png") };
  EXPECT_EQ(valuesOf(*openSpectralImage(files)), (Floats{ 0, 0, 0.2f, 0.2f, 1, 1 }));
  EXPECT_EQ(openSpectralImage(path("b.png"))->info().notes,
    (Files{ "uint16 samples were divided by 65535" }));
  SpectralImageOptions options;
  options.integers = msi::IntegerScaling::Raw;
  EXPECT_EQ(valuesOf(*openSpectralImage(files, options)), (Floats{ 0, 0, 51, 13107, 255, 65535 }));
}

TEST_F(ImageStacks, OneFileWithManyChannels)
{
  for (const char* layout : { "contig", "separate" })
  {
    OIIO::ImageSpec spec(2, 2, 5, OIIO::TypeDesc::UINT16);
    spec.attribute("planarconfig", layout);
    spec.alpha_channel = -1;
    Words pixels(20);
    Floats expected(20);
    for (std::size_t i = 0; i < 20; ++i)
    {
      pixels[i] = static_cast<std::uint16_t>(i * 1000);
      expected[i] = static_cast<float>(pixels[i] / 65535.0);
    }
    writeImage<std::uint16_t>(path("cube.tif"), { spec }, { pixels });
    const auto file = openSpectralImage(path("cube.tif"));
    ASSERT_EQ(file->info().bands(), 5) << layout;
    EXPECT_EQ(valuesOf(*file), expected) << layout;
  }
}

TEST_F(ImageStacks, OneFileWithManyPages)
{
  std::vector<OIIO::ImageSpec> specs;
  std::vector<Words> pages;
  for (int page = 0; page < 3; ++page)
  {
    specs.emplace_back(2, 1, 1, OIIO::TypeDesc::UINT16);
    specs.back().attribute("ImageDescription", std::to_string(700 - 100 * page) + " nm");
    pages.push_back({ static_cast<std::uint16_t>(page), static_cast<std::uint16_t>(10 + page) });
  }
  specs.emplace_back(1, 1, 1, OIIO::TypeDesc::UINT16);
  pages.push_back({ 77 });
  writeImage(path("pages.tif"), specs, pages);
  SpectralImageOptions options;
  options.integers = msi::IntegerScaling::Raw;
  const auto file = openSpectralImage(path("pages.tif"), options);
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 500, 600, 700 }));
  EXPECT_EQ(file->info().bandNames, (Files{ "page 3", "page 2", "page 1" }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 2, 1, 0, 12, 11, 10 }));
  EXPECT_EQ(file->info().notes, (Files{ "page 4 is 1 x 1 pixels, the first is 2 x 1: left out" }));
}

TEST_F(ImageStacks, TheDescriptionOfTheFirstPageMayListAllWavelengths)
{
  std::vector<OIIO::ImageSpec> specs(3, OIIO::ImageSpec(1, 1, 1, OIIO::TypeDesc::UINT8));
  specs[0].attribute(
    "ImageDescription", R"({"wavelengths": [700, 500.5, 600], "shape": [3, 1, 1]})");
  writeImage<std::uint8_t>(path("pages.tif"), specs, { { 7 }, { 5 }, { 6 } });
  SpectralImageOptions options;
  options.integers = msi::IntegerScaling::Raw;
  const auto file = openSpectralImage(path("pages.tif"), options);
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 500.5, 600, 700 }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 5, 6, 7 }));
  specs[0].attribute("ImageDescription", "Wavelengths: 700, 500");
  writeImage<std::uint8_t>(path("pages.tif"), specs, { { 7 }, { 5 }, { 6 } });
  EXPECT_TRUE(openSpectralImage(path("pages.tif"))->info().wavelengths.empty());
}

TEST_F(ImageStacks, ColorPicturesAreShownInTheirColors)
{
  writeImage(path("rgb.png"), 1, 1, 3, Bytes{ 255, 128, 0 });
  EXPECT_EQ(openSpectralImage(path("rgb.png"))->info().displayBands, (std::vector<int>{ 0, 1, 2 }));
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::UINT8);
  spec.channelnames = { "400nm", "500nm", "600nm" };
  writeImage<float>(path("spectral.exr"), { spec }, { { 0.1f, 0.2f, 0.3f } });
  EXPECT_TRUE(openSpectralImage(path("spectral.exr"))->info().displayBands.empty());
}

TEST_F(ImageStacks, TheNumberThatTellsTheFilesApartIsTheWavelength)
{
  const auto file = openSpectralImage(Files{ flat("s_550_gain200.tif", 3, 3),
    flat("s_450_gain200.tif", 1, 1), flat("s_500_gain200.tif", 2, 2) });
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 450, 500, 550 }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 1, 2, 3, 1, 2, 3 }));
}

TEST_F(ImageStacks, ChannelNamesTellWavelengths)
{
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::HALF);
  spec.channelnames = { "w1000nm", "w400nm", "w500nm" };
  writeImage<float>(path("c.exr"), { spec }, { { 10, 4, 5 } });
  const auto file = openSpectralImage(path("c.exr"));
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 400, 500, 1000 }));
  EXPECT_EQ(valuesOf(*file), (Floats{ 4, 5, 10 }));
}

TEST_F(ImageStacks, TilesAndOffsetDataWindows)
{
  OIIO::ImageSpec spec(37, 29, 2, OIIO::TypeDesc::FLOAT);
  spec.x = 5;
  spec.y = -3;
  spec.tile_width = spec.tile_height = 16;
  spec.channelnames = { "400nm", "500nm" };
  Floats pixels(37 * 29 * 2);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    pixels[i] = static_cast<float>(i);
  }
  writeImage<float>(path("t.exr"), { spec }, { pixels });
  const auto file = openSpectralImage(path("t.exr"));
  EXPECT_EQ(valuesOf(*file), pixels);
  Floats part(3 * 20);
  file->readBlock({ 11, 14, 7, 27 }, { 1 }, part.data());
  for (std::size_t y = 0; y < 20; ++y)
  {
    for (std::size_t x = 0; x < 3; ++x)
    {
      EXPECT_EQ(part[y * 3 + x], pixels[((y + 7) * 37 + x + 11) * 2 + 1]);
    }
  }
}

TEST_F(ImageStacks, RegionsBandsAndStrides)
{
  writeImage(path("a_400nm.tif"), 3, 3, 1, Floats{ 0, 1, 2, 3, 4, 5, 6, 7, 8 });
  writeImage(path("b_500nm.tif"), 3, 3, 1, Floats{ 10, 11, 12, 13, 14, 15, 16, 17, 18 });
  const auto file = openSpectralImage(Files{ path("a_400nm.tif"), path("b_500nm.tif") });
  std::vector<double> turned(2 * 2 * 2);
  file->readBlock({ 1, 3, 1, 3 }, { 1, 0 }, turned.data() + 4, -4);
  EXPECT_EQ(turned, (std::vector<double>{ 17, 7, 18, 8, 14, 4, 15, 5 }));
  file->readBlock({ 1, 1, 0, 3 }, {}, turned.data());
  EXPECT_THROW(file->readBlock({ 0, 4, 0, 3 }, {}, turned.data()), std::invalid_argument);
  EXPECT_THROW(file->readBlock({ 0, 1, 0, 1 }, { 2 }, turned.data()), std::invalid_argument);
}

TEST_F(ImageStacks, NaNStaysInItsPixel)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto pixels =
    valuesOf(*openSpectralImage(Files{ flat("a_400nm.tif", 1, nan), flat("b_500nm.tif", 3, 4) }));
  EXPECT_EQ(pixels[0], 1);
  EXPECT_EQ(pixels[1], 3);
  EXPECT_TRUE(std::isnan(pixels[2]));
  EXPECT_EQ(pixels[3], 4);
}

TEST_F(ImageStacks, ThreadsReadTheSameAsOne)
{
  constexpr int size = 64;
  Files files;
  for (int band = 0; band < 4; ++band)
  {
    Floats pixels(size * size);
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      pixels[i] = static_cast<float>(i) + 0.25f * static_cast<float>(band);
    }
    files.push_back(path("b_" + std::to_string(400 + 10 * band) + "nm.tif"));
    writeImage(files.back(), size, size, 1, pixels);
  }
  const auto file = openSpectralImage(files);
  const Floats expected = valuesOf(*file);
  Floats pixels(expected.size());
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
  {
    threads.emplace_back(
      [&file, &pixels, t]
      {
        for (int y = t; y < size; y += 4)
        {
          file->readBlock({ 0, size, y, y + 1 }, {}, pixels.data() + y * size * 4);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(pixels, expected);
}

TEST_F(ImageStacks, ErrorsNameTheFile)
{
  EXPECT_EQ(errorIn({}),
    "spectral image: no file was named; expected one file with many bands, or one file per band; "
    "name the files");
  const auto a = flat("a_400nm.tif", 1, 2);
  writeImage(path("b_500nm.tif"), 3, 1, 1, Floats{ 1, 2, 3 });
  EXPECT_EQ(errorIn({ a, path("b_500nm.tif") }),
    "b_500nm.tif: is 3 x 1 pixels; expected 2 x 1, as a_400nm.tif is; give images of one size");
  writeImage(path("rgb_500nm.png"), 2, 1, 3, Bytes{ 1, 2, 3, 4, 5, 6 });
  EXPECT_EQ(errorIn({ a, path("rgb_500nm.png") }),
    "rgb_500nm.png: has 3 channels (R, G, B); expected one channel in each file of a stack; "
    "convert "
    "the file to gray, or give it alone");
  EXPECT_EQ(errorIn({ a, flat("twin_400nm.tif", 1, 2) }),
    "twin_400nm.tif: 'a_400nm' and 'twin_400nm' both are 400 nm; expected one band for each "
    "wavelength; leave one out, or state the wavelengths");
  EXPECT_EQ(errorIn({ path("none.tif") }),
    "none.tif: cannot be read (No such file or directory); expected a readable file; check the "
    "name "
    "and the access rights");
  EXPECT_EQ(errorIn({ Folder.string() + "/" }).substr(0, 12), ": is a folde");
}

#ifdef __SANITIZE_ADDRESS__
// OpenImageIO's PNG reader leaks its message when libpng gives up.
constexpr const char* DamagedFormats[] = { "a.tif", "a.exr" };
#else
constexpr const char* DamagedFormats[] = { "a.tif", "a.exr", "a.png" };
#endif

TEST_F(ImageStacks, DamagedFilesAreToldNotShown)
{
  std::mt19937 random(1);
  Words pixels(64 * 64);
  std::generate(
    pixels.begin(), pixels.end(), [&random] { return static_cast<std::uint16_t>(random()); });
  for (const char* name : DamagedFormats)
  {
    writeImage(path(name), 64, 64, 1, pixels);
    const std::string whole = read(name);
    for (const std::size_t size : { whole.size() / 2, std::size_t{ 40 }, std::size_t{ 4 } })
    {
      const std::string cut = "cut_" + std::to_string(size) + name;
      write(cut, whole.substr(0, size));
      const std::string message = errorIn({ path(cut) });
      EXPECT_EQ(message.substr(0, cut.size()), cut) << message;
      EXPECT_NE(message.find("; expected "), std::string::npos) << message;
    }
  }
  for (const int tile : { 0, 16 })
  {
    OIIO::ImageSpec spec(64, 64, 1, OIIO::TypeDesc::UINT16);
    spec.attribute("compression", "zip");
    spec.tile_width = spec.tile_height = tile;
    writeImage<std::uint16_t>(path("z.tif"), { spec }, { pixels });
    std::string damaged = read("z.tif");
    damaged.replace(damaged.size() / 2, 400, 400, '\xAA');
    write("z.tif", damaged);
    EXPECT_EQ(errorIn({ path("z.tif") }).substr(0, 36), "z.tif: rows 1 to 64 cannot be read (");
  }
  write("text.tif", "this is no image");
  EXPECT_EQ(
    errorIn({ path("text.tif") }).substr(0, 40), "text.tif: cannot be opened as an image (");
}

TEST_F(ImageStacks, LabelsAreNotScaled)
{
  writeImage(path("l.png"), 3, 1, 1, Bytes{ 0, 1, 24 });
  EXPECT_EQ(msi::readLabelImage(path("l.png")).labels, (std::vector<std::int32_t>{ 0, 1, 24 }));
  writeImage(path("l.tif"), 2, 1, 1, std::vector<std::uint32_t>{ 70000, 0 });
  EXPECT_EQ(msi::readLabelImage(path("l.tif")).labels, (std::vector<std::int32_t>{ 70000, 0 }));
  writeImage(path("f.tif"), 2, 1, 1, Floats{ 1, 0.5f });
  EXPECT_EQ(errorOf([&] { msi::readLabelImage(path("f.tif")); }),
    "f.tif: the pixel in column 2 of row 1 is 0.5; expected whole numbers from 0 up; name a label "
    "image");
  writeImage(path("rgb.png"), 1, 1, 3, Bytes{ 1, 2, 3 });
  EXPECT_EQ(errorOf([&] { msi::readLabelImage(path("rgb.png")); }),
    "rgb.png: has 3 channels; expected a label image of one channel; save the labels as gray "
    "values, "
    "without a palette");
}

TEST_F(ImageStacks, AClassificationIsALabelImage)
{
  write("classes.img", std::string("\0\1\2\3\0\7", 6));
  const std::string header = write("classes.hdr",
    "ENVI\nsamples = 3\nlines = 2\nbands = 1\nfile type = ENVI Classification\ndata type = 1\n"
    "interleave = bsq\nclasses = 8\nclass names = {Unclassified, a, b, c, d, e, f, g}\n");
  EXPECT_EQ(msi::readLabelImage(header).labels, (std::vector<std::int32_t>{ 0, 1, 2, 3, 0, 7 }));
  EXPECT_NE(errorOf([&] { msi::openSpectralImage(header); }), "");
}

TEST_F(ImageStacks, ReadsThePublishedFilterWheelImages)
{
  MSI_MEASURED_DATA(folder, "filterwheel-cc24/");
  Files files;
  for (int nm = 700; nm >= 400; nm -= 50)
  {
    files.push_back(folder + "channel_" + std::to_string(nm) + "nm.tif");
  }
  const auto file = openSpectralImage(files);
  EXPECT_EQ(file->info().width, 408);
  EXPECT_EQ(file->info().height, 342);
  EXPECT_EQ(file->info().wavelengths, (std::vector<double>{ 400, 450, 500, 550, 600, 650, 700 }));
  const Floats pixels = valuesOf(*file);
  // Pillow 9.4 reads 0.076286174 in row 100, column 200 of channel_550nm.tif.
  EXPECT_EQ(pixels[(100 * 408 + 200) * 7 + 3], 0.076286174f);
  const auto labels = msi::readLabelImage(folder + "labels.png");
  EXPECT_EQ(*std::max_element(labels.labels.begin(), labels.labels.end()), 24);
  EXPECT_EQ(pixels.size(), 408u * 342u * 7u);
}

} // namespace

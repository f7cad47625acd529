#include "Formats/SpectralImageFile.h"
#include "Formats/SpectralImageWriter.h"

#include "Formats/Images/TestImages.h"
#include "Support/formats/TestFiles.h"

#include <cstring>
#include <limits>

namespace
{

using msi::openSpectralImage;
using Floats = std::vector<float>;
using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

Floats pixelsOf(const msi::SpectralImageFile& file)
{
  const auto& info = file.info();
  Floats pixels(static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height) *
    static_cast<std::size_t>(info.bands()));
  file.readBlock({ 0, info.width, 0, info.height }, {}, pixels.data());
  return pixels;
}

class SpectralExr : public msi::testing::TemporaryFolder
{
protected:
  std::string exr(const std::string& name, const Names& channels) const
  {
    OIIO::ImageSpec spec(1, 1, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = channels;
    spec.alpha_channel = -1;
    Floats values;
    for (std::size_t i = 0; i < channels.size(); ++i)
    {
      values.push_back(static_cast<float>(i));
    }
    msi::testing::writeImage<float>(path(name), { spec }, { values });
    return path(name);
  }
};

TEST_F(SpectralExr, ChannelsComeByWavelengthAndPreviewsStayOut)
{
  const auto file =
    openSpectralImage(exr("a.exr", { "R", "T.1000,000000nm", "B", "T.400,5nm", "T.0,5um" }));
  EXPECT_EQ(file->info().wavelengths, (Numbers{ 400.5, 500, 1000 }));
  EXPECT_EQ(file->info().quantity, "reflectance");
  EXPECT_EQ(pixelsOf(*file), (Floats{ 3, 4, 1 }));
  EXPECT_EQ(file->info().notes,
    (Names{ "2 channels without a wavelength (a color preview) were left out" }));
}

TEST_F(SpectralExr, EmissionPolarizationAndFluorescence)
{
  const auto file = openSpectralImage(
    exr("a.exr", { "S0.400,0nm", "S1.400,0nm", "S0.500,0nm", "T.350,0nm.400,0nm" }));
  EXPECT_EQ(file->info().quantity, "emission");
  EXPECT_EQ(pixelsOf(*file), (Floats{ 0, 2 }));
  EXPECT_EQ(file->info().notes,
    (Names{ "1 fluorescence channels were left out", "1 polarization channels were left out" }));
  EXPECT_EQ(errorOf(
              [&] {
                openSpectralImage(exr("b.exr", { "S1.400,0nm", "S2.400,0nm" }));
              }),
    "b.exr: has no plain spectral channel; expected channels T.<wavelength> or S0.<wavelength>; "
    "name "
    "another file");
  EXPECT_EQ(errorOf(
              [&] {
                openSpectralImage(exr("c.exr", { "T.400,0nm", "T.0,4um" }));
              }),
    "c.exr: 'T.0,4um' and 'T.400,0nm' both are 400 nm; expected one band for each wavelength; "
    "leave "
    "one out, or state the wavelengths");
}

msi::SpectralImageInfo exrInfo()
{
  msi::SpectralImageInfo info;
  info.width = 3;
  info.height = 2;
  info.bandNames = { "a", "b" };
  info.wavelengths = { 400, 1000.25 };
  return info;
}

TEST_F(SpectralExr, WrittenFilesReadBackToTheLastBit)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Floats pixels{ 0.1f, 1e-30f, 3, 4, 5, -6, 7, 8, 1.0f / 3, 10, nan, 12 };
  for (const char* quantity : { "reflectance", "emission" })
  {
    auto info = exrInfo();
    info.quantity = quantity;
    const auto writer = msi::createSpectralImage(path("out.exr"), info);
    writer->writeRows(1, pixels.data() + 6, 6);
    writer->writeRows(1, std::vector<double>(pixels.begin(), pixels.begin() + 6).data());
    writer->finish();
    const auto file = openSpectralImage(path("out.exr"));
    EXPECT_EQ(file->info().wavelengths, info.wavelengths);
    EXPECT_EQ(file->info().quantity, quantity);
    EXPECT_EQ(file->info().metadata.at("spectrallayoutversion"), "1.0");
    const Floats back = pixelsOf(*file);
    Floats expected(pixels.begin() + 6, pixels.end());
    expected.insert(expected.end(), pixels.begin(), pixels.begin() + 6);
    ASSERT_EQ(back.size(), expected.size());
    EXPECT_EQ(std::memcmp(back.data(), expected.data(), back.size() * sizeof(float)), 0);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(Folder), {}), 1);
  }
  const auto input = OIIO::ImageInput::open(path("out.exr"));
  EXPECT_EQ(input->spec().channelnames, (Names{ "S0.1000,25nm", "S0.400nm" }));
}

TEST_F(SpectralExr, WriterIsCompleteOrAbsent)
{
  {
    const auto writer = createSpectralExr(path("out.exr"), exrInfo());
    writer->writeRows(1, Floats(6).data());
    EXPECT_THROW(writer->writeRows(2, Floats(12).data()), std::invalid_argument);
    EXPECT_THROW(writer->finish(), std::invalid_argument);
  }
  EXPECT_TRUE(std::filesystem::is_empty(Folder));
  EXPECT_EQ(errorOf([&] { createSpectralExr(path("no/out.exr"), exrInfo()); }).substr(0, 30),
    "no/out.exr: cannot be written ");
  auto info = exrInfo();
  info.wavelengths.clear();
  EXPECT_THROW(createSpectralExr(path("out.exr"), info), std::invalid_argument);
  info.wavelengths = { 400, 400 };
  EXPECT_THROW(createSpectralExr(path("out.exr"), info), std::invalid_argument);
}

TEST_F(SpectralExr, ReadsPublishedFiles)
{
  MSI_MEASURED_DATA(folder, "files/");
  const auto light = openSpectralImage(folder + "D65.exr");
  EXPECT_EQ(light->info().quantity, "emission");
  EXPECT_EQ(light->info().bands(), 90);
  EXPECT_EQ(light->info().wavelengths.front(), 380);
  EXPECT_EQ(light->info().wavelengths.back(), 825);
  const auto chart = openSpectralImage(folder + "Macbeth.exr");
  EXPECT_EQ(chart->info().quantity, "reflectance");
  EXPECT_EQ(chart->info().width, 600);
  EXPECT_EQ(chart->info().height, 400);
  EXPECT_EQ(chart->info().bands(), 36);
  const Floats pixels = pixelsOf(*chart);
  // The file stores a constant color in each of its 6 x 4 patches, all between 0 and 1.
  const float* patch = pixels.data() + (50 * 600 + 50) * 36;
  const float* beside = pixels.data() + (60 * 600 + 40) * 36;
  for (int b = 0; b < 36; ++b)
  {
    EXPECT_GT(patch[b], 0.0f);
    EXPECT_LT(patch[b], 1.0f);
    EXPECT_EQ(patch[b], beside[b]);
  }
}

} // namespace

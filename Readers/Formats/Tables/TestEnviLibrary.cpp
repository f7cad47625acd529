#include "Formats/SampleTable.h"

#include "Support/formats/TestFiles.h"

#include "Formats/SpectralImageFile.h"

#include <cstring>

namespace
{

class EnviLibraries : public msi::testing::TemporaryFolder
{
protected:
  static std::string bytesOf(const std::vector<float>& values)
  {
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
  }

  // Two spectra of three wavelengths, as ENVI stores them: a line per spectrum.
  std::string library(const std::string& more, const std::string& bytes) const
  {
    write("pigments.sli", bytes);
    return write("pigments.hdr",
      "ENVI\nsamples = 3\nlines = 2\nbands = 1\nheader offset = 0\nfile type = ENVI Spectral "
      "Library\n"
      "data type = 4\ninterleave = bsq\nbyte order = 0\n" +
        more);
  }

  const std::string Names = "spectra names = {azurite, lead white}\n";
  const std::string Micrometres = "wavelength units = Micrometers\nwavelength = {0.4, 0.5, 0.6}\n";
  const std::string Bytes = bytesOf({ 0.1F, 0.2F, 0.3F, 0.7F, 0.8F, 0.9F });
};

TEST_F(EnviLibraries, AreSampleTables)
{
  const std::string header = library(Names + Micrometres, Bytes);
  for (const std::string& file : { header, path("pigments.sli") })
  {
    const msi::SampleTable table = msi::readSampleTable(file);
    EXPECT_EQ(table.sampleNames(), (std::vector<std::string>{ "azurite", "lead white" }));
    EXPECT_EQ(table.wavelengths, msi::WavelengthGrid({ 400, 500, 600 }));
    EXPECT_EQ(table.reflectance.cast<float>(),
      (Eigen::MatrixXf(3, 2) << 0.1F, 0.7F, 0.2F, 0.8F, 0.3F, 0.9F).finished());
  }
}

TEST_F(EnviLibraries, InPercentAndWithAScaleFactor)
{
  library(Micrometres, bytesOf({ 10, 20, 30, 70, 80, 90 }));
  EXPECT_EQ(msi::readSampleTable(path("pigments.sli")).reflectance,
    (Eigen::MatrixXd(3, 2) << 0.1, 0.7, 0.2, 0.8, 0.3, 0.9).finished());
  library(
    Micrometres + "reflectance scale factor = 1000\n", bytesOf({ 100, 200, 300, 700, 800, 900 }));
  EXPECT_EQ(msi::readSampleTable(path("pigments.sli")).reflectance,
    (Eigen::MatrixXd(3, 2) << 0.1, 0.7, 0.2, 0.8, 0.3, 0.9).finished());
}

TEST_F(EnviLibraries, WhatIsWrongIsSaid)
{
  const auto message = [&](const std::string& more, const std::string& bytes)
  { return errorOf([&] { msi::readSampleTable(library(more, bytes)); }); };
  EXPECT_EQ(message(Names, Bytes),
    "pigments.hdr: states no wavelengths; expected 'wavelength' with one number for each of 3 "
    "bands; add them: "
    "a spectral library without them is no sample table");
  EXPECT_EQ(message(Names + Micrometres, Bytes.substr(4)),
    "pigments.sli: holds 20 bytes; expected 24 bytes (header offset 0 + 2 samples x 1 lines x 3 "
    "bands x 4 bytes), "
    "as " +
      path("pigments.hdr").substr(path("").size()) +
      " says; the file seems to be cut off, or the header belongs to another file");
  EXPECT_EQ(message(Names + Micrometres + "data ignore value = 0.7\n",
              bytesOf({ 0.1F, 0.2F, 0.3F, 0.5F, -1.23e34F, 0.9F })),
    "pigments.sli: sample 'lead white' has a reflectance factor at 500 nm of "
    "-1.2300000156674078e+34; expected -1 to "
    "100, where 1 is the perfect white; remove the sample if this marks a missing value");
  EXPECT_EQ(message(Names + Micrometres + "data ignore value = 0.5\n",
              bytesOf({ 0.1F, 0.2F, 0.3F, 0.5F, 0.8F, 0.9F })),
    "pigments.sli: spectrum 'lead white' has no value at 400 nm; expected finite numbers; remove "
    "the spectrum");
}

TEST_F(EnviLibraries, AreNoImages)
{
  EXPECT_EQ(errorOf([&] { msi::openSpectralImage(library(Names + Micrometres, Bytes)); }),
    "pigments.hdr:6:1: 'file type' is 'ENVI Spectral Library'; expected 'ENVI Standard', an image "
    "of samples; read it "
    "as a sample table, or name an image");
}

}

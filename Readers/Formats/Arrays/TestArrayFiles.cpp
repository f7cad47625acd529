#include "Formats/Arrays/TestMatFiles.h"
#include "Formats/Images/ArrayImage.h"
#include "Formats/SampleTable.h"
#include "Formats/SpectralImageFile.h"
#include "Support/formats/TestFiles.h"

#include <cmath>
#include <limits>
#include <thread>

namespace
{

using msi::openSpectralImage;
using msi::readSampleTable;
using msi::testing::MatWriter;
using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

Numbers allOf(const msi::SpectralImageFile& file)
{
  const auto& info = file.info();
  Numbers pixels(static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height) *
    static_cast<std::size_t>(info.bands()));
  file.readBlock({ 0, info.width, 0, info.height }, {}, pixels.data());
  return pixels;
}

// MATLAB cube of 2 rows x 3 columns x 4 bands; the value is 100 row + 10 column + band.
std::vector<unsigned short> cube()
{
  std::vector<unsigned short> values;
  for (int b = 0; b < 4; ++b)
  {
    for (int x = 0; x < 3; ++x)
    {
      for (int y = 0; y < 2; ++y)
      {
        values.push_back(static_cast<unsigned short>(100 * y + 10 * x + b));
      }
    }
  }
  return values;
}

class ArrayFiles
  : public msi::testing::TemporaryFolder
  , public ::testing::WithParamInterface<mat_ft>
{
protected:
  MatWriter writer(const std::string& name = "a.mat") const { return { path(name), GetParam() }; }
  std::string imageError(const msi::SpectralImageOptions& options = {}) const
  {
    return errorOf([&] { allOf(*openSpectralImage(path("a.mat"), options)); });
  }
  std::string tableError(const msi::SampleTableOptions& options = {}) const
  {
    return errorOf([&] { readSampleTable(path("a.mat"), options); });
  }
};

// What level 4 has, too.
class Matrices : public ArrayFiles
{
};

TEST_P(ArrayFiles, ACubeIsAnImage)
{
  writer().add("cube", { 2, 3, 4 }, cube()).add("lambda", { 1, 4 }, Numbers{ 700, 600, 500, 400 });
  const auto file = openSpectralImage(path("a.mat"));
  EXPECT_EQ(file->info().format, "MAT");
  EXPECT_EQ(file->info().width, 3);
  EXPECT_EQ(file->info().height, 2);
  EXPECT_EQ(file->info().sampleType, "uint16");
  EXPECT_EQ(file->info().wavelengths, (Numbers{ 400, 500, 600, 700 }));
  EXPECT_EQ(allOf(*file),
    (Numbers{ 3, 2, 1, 0, 13, 12, 11, 10, 23, 22, 21, 20, 103, 102, 101, 100, 113, 112, 111, 110,
      123, 122, 121, 120 }));
  Numbers part(4);
  file->readBlock({ 1, 3, 1, 2 }, { 2, 0 }, part.data());
  EXPECT_EQ(part, (Numbers{ 111, 113, 121, 123 }));
}

TEST_P(ArrayFiles, StructuresAreLookedInto)
{
  writer().addStructure("data", "rad", { 2, 3, 4 }, cube(), "bands", { 400, 500, 600, 700 });
  const auto file = openSpectralImage(path("a.mat"));
  EXPECT_EQ(file->info().wavelengths, (Numbers{ 400, 500, 600, 700 }));
  EXPECT_EQ(allOf(*file),
    (Numbers{ 0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23, 100, 101, 102, 103, 110, 111, 112, 113,
      120, 121, 122, 123 }));
  const std::string separator = GetParam() == MAT_FT_MAT5 ? "." : "/";
  EXPECT_EQ(file->info().notes, (Names{ "wavelengths are those of 'data" + separator + "bands'" }));
  msi::SpectralImageOptions options;
  options.variable = "data" + separator + "rad";
  EXPECT_EQ(openSpectralImage(path("a.mat"), options)->info().bands(), 4);
}

TEST_P(ArrayFiles, OfSeveralCubesThatOfTheWavelengthsIsMeant)
{
  writer()
    .add("rgb", { 4, 2, 3 }, cube())
    .add("rad", { 2, 3, 4 }, cube())
    .add("bands", { 1, 4 }, Numbers{ 1, 2, 3, 4 });
  EXPECT_NE(imageError(), ""); // both have an axis of four, and the bands are only counted
  writer()
    .add("rgb", { 8, 1, 3 }, cube())
    .add("rad", { 2, 3, 4 }, cube())
    .add("bands", { 1, 4 }, Numbers{ 400, 500, 600, 700 });
  const auto file = openSpectralImage(path("a.mat"));
  EXPECT_EQ(file->info().metadata.at("variable"), "rad");
  EXPECT_EQ(file->info().wavelengths, (Numbers{ 400, 500, 600, 700 }));
}

TEST_P(ArrayFiles, WavelengthsTellTheSpectralAxis)
{
  // Bands, rows, columns: 2 x 3 x 4.
  writer().add("cube", { 2, 3, 4 }, cube());
  msi::SpectralImageOptions options;
  options.wavelengths = { 400, 500 };
  const auto file = openSpectralImage(path("a.mat"), options);
  EXPECT_EQ(file->info().bands(), 2);
  EXPECT_EQ(file->info().height, 3);
  EXPECT_EQ(file->info().width, 4);
  const Numbers pixels = allOf(*file);
  EXPECT_EQ(Numbers(pixels.begin(), pixels.begin() + 4), (Numbers{ 0, 100, 1, 101 }));
  const auto guessed = openSpectralImage(path("a.mat"));
  EXPECT_EQ(guessed->info().bands(), 4);
  EXPECT_EQ(guessed->info().notes,
    (Names{ "bands were taken along axis 3 of 'cube', which is 2 x 3 x 4" }));
}

TEST_P(ArrayFiles, AMatrixIsOneBandWhereItIsNamed)
{
  writer().add("m", { 2, 3 }, Numbers{ 1, 2, 3, 4, 5, 6 });
  EXPECT_EQ(imageError(),
    "a.mat: holds no array of three axes, only m (2 x 3); expected one array of rows, columns and "
    "bands; read it as a sample table, or name a matrix");
  msi::SpectralImageOptions options;
  options.variable = "m";
  const auto file = openSpectralImage(path("a.mat"), options);
  EXPECT_EQ(file->info().bands(), 1);
  EXPECT_EQ(allOf(*file), (Numbers{ 1, 3, 5, 2, 4, 6 }));
}

TEST_P(ArrayFiles, ImageErrorsListTheArrays)
{
  writer()
    .add("a", { 2, 3, 4 }, cube())
    .add("b", { 4, 3, 2 }, cube())
    .add("v", { 1, 2 }, Numbers{ 1, 2 });
  EXPECT_EQ(imageError(),
    "a.mat: holds several arrays of three axes: a (2 x 3 x 4), b (4 x 3 x 2); expected "
    "one "
    "array of rows, columns and bands; name the one to read");
  EXPECT_EQ(msi::imageVariables(path("a.mat")), (Names{ "a", "b" }));
  msi::SpectralImageOptions options;
  options.variable = "c";
  EXPECT_EQ(imageError(options),
    "a.mat: has no array 'c'; expected one of a (2 x 3 x 4), b (4 x 3 x 2), v (1 x 2); name one of "
    "them");
  options.variable = "v";
  EXPECT_EQ(imageError(options),
    "a.mat: 'v' is 1 x 2; expected an array of three axes (rows, columns, bands), or two for one "
    "band; "
    "name another array");
  options.variable = "b";
  options.wavelengths = { 401, 402, 403 };
  EXPECT_EQ(errorOf([&] { openSpectralImage(path("a.mat"), options); }), "");
  options.wavelengths = { 401, 402, 403, 404, 405 };
  EXPECT_EQ(imageError(options),
    "a.mat: 5 wavelengths were given; expected 2, one for each band; complete the list");
}

TEST_P(Matrices, AreASampleTable)
{
  // 2 wavelengths x 3 samples, 4 channels x 3 samples.
  writer()
    .add("refl", { 2, 3 }, Numbers{ 0.1, 0.2, 0.3, 0.4, 0.5, 0.6 })
    .add("cam", { 3, 4 }, Numbers{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 })
    .add("wavelengths", { 2, 1 }, Numbers{ 0.5, 0.6 })
    .add("names", { "red ", "blue", "tan " });
  const auto table = readSampleTable(path("a.mat"));
  EXPECT_EQ(table.wavelengths->values(), (Numbers{ 500, 600 }));
  EXPECT_EQ(table.reflectance.col(1), Eigen::Vector2d(0.3, 0.4));
  EXPECT_EQ(table.responses.col(1), Eigen::Vector4d(2, 5, 8, 11));
  EXPECT_EQ(table.sampleNames(), (Names{ "red", "blue", "tan" }));
  EXPECT_EQ(table.notes.back(), "wavelengths are those of 'wavelengths'");
}

TEST_P(Matrices, CutShortAreTold)
{
  writer().add("refl", { 31, 3 }, Numbers(93, 0.5)).add("more", { 31, 200 }, Numbers(6200, 0.25));
  const std::string whole = read("a.mat");
  for (const std::size_t size : { whole.size() / 2, whole.size() - 100 })
  {
    write("a.mat", whole.substr(0, size));
    const std::string message = tableError();
    EXPECT_EQ(message.substr(0, 7), "a.mat: ") << size << ": " << message;
    EXPECT_NE(message.find("; expected "), std::string::npos) << size << ": " << message;
  }
}

TEST_P(ArrayFiles, TableErrorsListTheArrays)
{
  writer()
    .add("r", { 2, 3 }, Numbers{ 1, 2, 3, 4, std::nan(""), 6 })
    .add("v", { 1, 2 }, Numbers{ 1, 2 });
  EXPECT_EQ(tableError(),
    "a.mat: no matrix has a side of 31; it holds r (2 x 3), v (1 x 2); expected one matrix with a "
    "side "
    "as long as the wavelengths; state the wavelengths, or name the variable of the reflectance");
  msi::SampleTableOptions options;
  options.wavelengths = msi::WavelengthGrid({ 500, 600 });
  EXPECT_EQ(tableError(options),
    "a.mat: 'r' holds nan as element 5; expected finite numbers; remove the sample");
  options.reflectanceVariable = "v";
  EXPECT_EQ(tableError(options),
    "a.mat: 'v' is 1 x 2; expected a matrix of bands and samples; name another variable");
}

TEST_P(ArrayFiles, WhatIsNoNumberIsLeftOut)
{
  writer().addComplex("z");
  const std::string message = imageError();
  EXPECT_EQ(message.substr(0, 40), "a.mat: holds no array of real numbers; e");
}

TEST_P(ArrayFiles, DamagedFilesAreTold)
{
  Numbers values(40 * 40 * 10);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = std::sin(static_cast<double>(i * i));
  }
  writer().add("cube", { 40, 40, 10 }, values);
  const std::string whole = read("a.mat");
  for (const std::size_t size : { whole.size() / 2, whole.size() - 100, std::size_t{ 600 } })
  {
    write("a.mat", whole.substr(0, size));
    const std::string message = imageError();
    EXPECT_EQ(message.substr(0, 7), "a.mat: ") << size << ": " << message;
    EXPECT_NE(message.find("; expected "), std::string::npos) << size << ": " << message;
  }
}

TEST_P(ArrayFiles, ThreadsReadTheSameAsOne)
{
  writer().add("cube", { 2, 3, 4 }, cube());
  const auto file = openSpectralImage(path("a.mat"));
  const Numbers expected = allOf(*file);
  Numbers first(12);
  Numbers second(12);
  std::thread other([&] { file->readBlock({ 0, 3, 0, 1 }, {}, first.data()); });
  file->readBlock({ 0, 3, 1, 2 }, {}, second.data());
  other.join();
  first.insert(first.end(), second.begin(), second.end());
  EXPECT_EQ(first, expected);
}

TEST_P(ArrayFiles, CutOffAfterOpening)
{
  // Not compressed: HDF5 itself gives zeros for samples behind the end of the file.
  constexpr std::size_t Side = 128;
  MatWriter(path("a.mat"), GetParam(), MAT_COMPRESSION_NONE)
    .add("cube", { Side, Side, 4 }, std::vector<unsigned short>(Side * Side * 4, 7));
  const auto file = openSpectralImage(path("a.mat"));
  std::filesystem::resize_file(path("a.mat"), std::filesystem::file_size(path("a.mat")) / 2);
  EXPECT_NE(errorOf([&] { allOf(*file); }).find("the file "), std::string::npos);
}

std::string levelOf(const ::testing::TestParamInfo<mat_ft>& tested)
{
  return tested.param == MAT_FT_MAT4 ? "Level4" : tested.param == MAT_FT_MAT5 ? "Level5" : "Hdf5";
}

INSTANTIATE_TEST_SUITE_P(Mat, ArrayFiles, ::testing::Values(MAT_FT_MAT5, MAT_FT_MAT73), levelOf);
INSTANTIATE_TEST_SUITE_P(
  Mat, Matrices, ::testing::Values(MAT_FT_MAT4, MAT_FT_MAT5, MAT_FT_MAT73), levelOf);

class PublishedMat : public msi::testing::TemporaryFolder
{
};

TEST_F(PublishedMat, KuopioMunsell)
{
  MSI_MEASURED_DATA(file, "files/Kuopio_Typical.mat");
  const auto table = readSampleTable(file);
  EXPECT_EQ(table.sampleCount(), 32);
  EXPECT_EQ(table.reflectance.rows(), 31);
  EXPECT_EQ(table.responses.rows(), 16);
  // SciPy 1.10 reads munsell(0, 0) = 19.65 (percent) and S[0] = '5R 6/6'.
  EXPECT_DOUBLE_EQ(table.reflectance(0, 0), 0.1965);
  EXPECT_EQ(table.sampleNames()[0], "5R 6/6");
  EXPECT_EQ(errorOf([&] { openSpectralImage(file); }),
    file +
      ": holds no array of three axes, only munsell (31 x 32), S (32 x 8), C (16 x 32); expected "
      "one array of rows, columns and bands; read it as a sample table, or name a matrix");
}

} // namespace

#include "Formats/SpectralImageFile.h"
#include "Formats/SpectralImageWriter.h"

#include "Support/formats/TestFiles.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace
{

using msi::openSpectralImage;
using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

// 2 columns, 3 rows, 4 bands; the value tells its place: 100 row + 10 column + band.
constexpr int Width = 2;
constexpr int Height = 3;
constexpr int Bands = 4;

Numbers allOf(const msi::SpectralImageFile& file)
{
  const auto& info = file.info();
  Numbers pixels(static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height) *
    static_cast<std::size_t>(info.bands()));
  file.readBlock({ 0, info.width, 0, info.height }, {}, pixels.data());
  return pixels;
}

class EnviImages : public msi::testing::TemporaryFolder
{
protected:
  static std::string header(const std::string& interleave, const std::string& more = {})
  {
    return "ENVI\nsamples = 2\nlines = 3\nbands = 4\ndata type = 2\nbyte order = 0\ninterleave = " +
      interleave + "\n" + more;
  }

  // Little-endian 16 bit, laid out by hand.
  static std::string samples(const std::string& interleave)
  {
    std::string bytes;
    const auto add = [&bytes](int y, int x, int b)
    {
      const int value = 100 * y + 10 * x + b;
      bytes += static_cast<char>(value & 0xFF);
      bytes += static_cast<char>(value >> 8);
    };
    for (int i = 0; i < (interleave == "bsq" ? Bands : Height); ++i)
    {
      for (int j = 0; j < (interleave == "bsq" ? Height : interleave == "bil" ? Bands : Width); ++j)
      {
        for (int k = 0; k < (interleave == "bip" ? Bands : Width); ++k)
        {
          interleave == "bsq" ? add(j, k, i) : interleave == "bil" ? add(i, k, j) : add(i, j, k);
        }
      }
    }
    return bytes;
  }

  static Numbers expected()
  {
    Numbers values;
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        for (int b = 0; b < Bands; ++b)
        {
          values.push_back(100 * y + 10 * x + b);
        }
      }
    }
    return values;
  }

  std::string image(const std::string& more = {}, const std::string& interleave = "bil") const
  {
    write("a.img", samples(interleave));
    return write("a.hdr", header(interleave, more));
  }

  std::string errorIn(const std::string& file) const
  {
    return errorOf([&] { allOf(*openSpectralImage(file)); });
  }
};

TEST_F(EnviImages, EveryInterleaveWholeAndInParts)
{
  for (const std::string interleave : { "bsq", "bil", "bip" })
  {
    const auto file = openSpectralImage(image({}, interleave));
    EXPECT_EQ(file->info().format, "ENVI");
    EXPECT_EQ(file->info().sampleType, "int16");
    EXPECT_EQ(allOf(*file), expected()) << interleave;
    Numbers part(2);
    file->readBlock({ 1, 2, 2, 3 }, { 3, 1 }, part.data());
    EXPECT_EQ(part, (Numbers{ 213, 211 })) << interleave;
    file->readBlock({ 1, 2, 1, 3 }, { 2 }, part.data());
    EXPECT_EQ(part, (Numbers{ 112, 212 })) << interleave;
    Numbers turned(4);
    file->readBlock({ 0, 2, 0, 2 }, { 0 }, turned.data() + 2, -2);
    EXPECT_EQ(turned, (Numbers{ 100, 110, 0, 10 })) << interleave;
    std::vector<float> single(2 * 4);
    file->readBlock({ 0, 2, 1, 2 }, { 0, 1, 2, 3 }, single.data());
    EXPECT_EQ(single, (std::vector<float>{ 100, 101, 102, 103, 110, 111, 112, 113 })) << interleave;
  }
}

TEST_F(EnviImages, HeaderAndDataFileFindEachOther)
{
  const std::pair<const char*, const char*> pairs[] = { { "a.hdr", "a.img" }, { "b.hdr", "b" },
    { "c.hdr", "c.dat" }, { "d.raw.hdr", "d.raw" }, { "e.HDR", "e.BIL" }, { "f.hdr", "f.bsq" },
    { "g.bip.hdr", "g.bip" }, { "h.hdr", "h.raw" }, { "i.j.hdr", "i.j" } };
  for (const auto& [headerName, dataName] : pairs)
  {
    const std::string headerFile = write(headerName, header("bip"));
    const std::string dataFile = write(dataName, samples("bip"));
    EXPECT_EQ(allOf(*openSpectralImage(headerFile)), expected()) << headerName;
    EXPECT_EQ(allOf(*openSpectralImage(dataFile)), expected()) << dataName;
    EXPECT_EQ(allOf(*openSpectralImage(Names{ dataFile, headerFile })), expected()) << dataName;
  }
}

TEST_F(EnviImages, BandsComeByWavelength)
{
  const auto file = openSpectralImage(
    image("wavelength = {700, 500, 400, 600}\nwavelength units = nm\nbbl = {1, 1, 0, 1}\n"
          "band names = {d, b, a, c}\ndefault bands = {1, 4, 3}\nfwhm = {4, 2, 1, 3}\n"));
  EXPECT_EQ(file->info().wavelengths, (Numbers{ 400, 500, 600, 700 }));
  EXPECT_EQ(file->info().bandNames, (Names{ "a", "b", "c", "d" }));
  EXPECT_EQ(file->info().goodBands, (std::vector<bool>{ false, true, true, true }));
  EXPECT_EQ(file->info().displayBands, (std::vector<int>{ 3, 2, 0 }));
  EXPECT_EQ(file->info().fwhm, (Numbers{ 1, 2, 3, 4 }));
  EXPECT_EQ(file->info().notes, (Names{ "bands were sorted by wavelength" }));
  const Numbers pixels = allOf(*file);
  EXPECT_EQ(Numbers(pixels.begin(), pixels.begin() + 4), (Numbers{ 2, 1, 3, 0 }));
}

TEST_F(EnviImages, WavelengthsThatAreNoGridAreForgottenAndSaid)
{
  const auto notesWith = [this](const std::string& list)
  {
    const auto file =
      openSpectralImage(image("wavelength = {" + list + "}\nwavelength units = nm\n"));
    EXPECT_TRUE(file->info().wavelengths.empty());
    return file->info().notes;
  };
  EXPECT_EQ(
    notesWith("400, 500, 500, 600"), (Names{ "the wavelengths are unknown: two are 500 nm" }));
  EXPECT_EQ(
    notesWith("0.4, 500, 600, 700"), (Names{ "the wavelengths are unknown: one is 0.4 nm" }));
  EXPECT_EQ(notesWith("400, 0.0, 600, 700"),
    (Names{ "the wavelengths were forgotten: that of band 2 is 0" }));
  EXPECT_EQ(notesWith("400, 500, 600, -1"),
    (Names{ "the wavelengths were forgotten: that of band 4 is -1" }));
  msi::SpectralImageOptions options;
  options.wavelengths = { 400, 500, 400, 600 };
  EXPECT_EQ(errorOf([&] { openSpectralImage(image(), options); }),
    "a.hdr: of the wavelengths given two are 400 nm; expected different wavelengths from 100 to "
    "20000 "
    "nm; correct the list");
}

TEST_F(EnviImages, ScaleAndIgnoreValue)
{
  const auto pixels =
    allOf(*openSpectralImage(image("reflectance scale factor = 100\ndata ignore value = 112\n")));
  EXPECT_EQ(pixels[0], 0.0);
  EXPECT_EQ(pixels[13], 1.11);
  EXPECT_TRUE(std::isnan(pixels[14]));
  EXPECT_EQ(pixels[15], 1.13);
}

TEST_F(EnviImages, IgnoreValuesAreComparedAsStored)
{
  float sample = -std::numeric_limits<float>::max();
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &sample, 4);
  write("f.img", bytes);
  const auto file = openSpectralImage(write("f.hdr",
    "ENVI\nsamples = 1\nlines = 1\nbands = 1\ndata type = 4\ninterleave = bsq\nbyte order = 0\n"
    "data ignore value = -3.40282347e+38\n"));
  EXPECT_TRUE(std::isnan(allOf(*file)[0]));
}

TEST_F(EnviImages, SizesThatDisagreeAreToldWithBothNumbers)
{
  const auto file = image();
  write("a.img", samples("bil").substr(0, 40));
  EXPECT_EQ(errorIn(file),
    "a.img: holds 40 bytes; expected 48 bytes (header offset 0 + 2 samples x 3 lines x 4 bands x 2 "
    "bytes), as a.hdr says; the file seems to be cut off, or the header belongs to another file");
  write("a.img", samples("bil") + "more");
  EXPECT_EQ(openSpectralImage(file)->info().notes[0],
    "the data file holds 52 bytes, the header asks for 48 bytes (header offset 0 + 2 samples x 3 "
    "lines "
    "x 4 bands x 2 bytes): the rest was left unread");
  write("a.hdr", header("bil", "header offset = 5\n"));
  EXPECT_EQ(
    errorIn(file).substr(0, 61), "a.img: holds 52 bytes; expected 53 bytes (header offset 5 + 2");
}

TEST_F(EnviImages, AFileCutOffAfterOpeningIsAnErrorNotACrash)
{
  const auto file = openSpectralImage(image());
  std::filesystem::resize_file(path("a.img"), 20);
  Numbers pixels(24);
  EXPECT_EQ(errorOf(
              [&] {
                file->readBlock({ 0, 2, 0, 3 }, {}, pixels.data());
              }),
    "a.img: ends at offset 20; expected 28 more bytes; the file seems to have been cut off; copy "
    "it "
    "again");
}

TEST_F(EnviImages, TheDataFileMayHaveAnExtensionOfItsMaker)
{
  image();
  std::filesystem::rename(path("a.img"), path("a.hyspex"));
  write("a.png", "a picture beside it");
  EXPECT_EQ(errorIn(path("a.hdr")), "");
  EXPECT_EQ(errorIn(path("a.hyspex")), "");
  write("a.spe", "another");
  EXPECT_EQ(errorIn(path("a.hdr")),
    "a.hdr: has several files beside it that may be its data; expected a or a with .img, .dat, "
    ".raw, .bil, .bsq, .bip, .bin or .cube; open the data file instead");
  EXPECT_EQ(errorIn(path("a.hyspex")), "");
}

TEST_F(EnviImages, AFileOfAnotherKindIsNotReadAsItsData)
{
  image();
  for (const char* extension :
    { ".jpg", ".JPG", ".bmp", ".txt", ".csv", ".log", ".xml", ".json", ".pdf", ".hyspex" })
  {
    // As long as the data, so that only its name tells.
    const std::string other = write(std::string("a") + extension, samples("bil"));
    EXPECT_NE(errorIn(other), "") << extension;
  }
  EXPECT_EQ(errorIn(path("a.hdr")), "");
  EXPECT_EQ(errorIn(path("a.img")), "");
  // A header that bears the whole name means this very file.
  write("b.txt", samples("bil"));
  write("b.txt.hdr", header("bil"));
  EXPECT_EQ(errorIn(path("b.txt")), "");
  EXPECT_EQ(errorIn(path("b.txt.hdr")), "");
}

TEST_F(EnviImages, AHeaderMayBeUtf16)
{
  const std::string text = read(std::filesystem::path(image()).filename().string());
  std::string wide = "\xFF\xFE";
  for (const char c : text)
  {
    wide += { c, '\0' };
  }
  EXPECT_EQ(allOf(*openSpectralImage(write("a.hdr", wide))), expected());
  EXPECT_EQ(allOf(*openSpectralImage(path("a.img"))), expected());
}

TEST_F(EnviImages, GivenWavelengthsMendAHeader)
{
  const std::string file = image("wavelength = {0}\n");
  EXPECT_NE(errorIn(file), "");
  msi::SpectralImageOptions options;
  options.wavelengths = { 400, 500, 600, 700 };
  EXPECT_EQ(openSpectralImage(file, options)->info().wavelengths, options.wavelengths);
}

TEST_F(EnviImages, LonelyFilesAreTold)
{
  EXPECT_EQ(errorIn(write("x.hdr", header("bil"))),
    "x.hdr: has no data file beside it; expected x or x with .img, .dat, .raw, .bil, .bsq, .bip, "
    ".bin "
    "or .cube; put the data file beside the header");
  EXPECT_EQ(errorIn(write("y.bil", "12345678")),
    "y.bil: has no header beside it; expected y.bil.hdr or y.hdr; put the ENVI header beside the "
    "data "
    "file");
  EXPECT_EQ(errorIn(write("z.hdr", "nonsense\n")),
    "z.hdr:1:1: the first line is 'nonsense'; expected ENVI; name an ENVI header or its data file");
  EXPECT_EQ(errorIn(write("header.txt", header("bil"))),
    "header.txt: is an ENVI header without the extension .hdr; expected a header named like its "
    "data "
    "file, with .hdr; rename the header");
  EXPECT_EQ(errorIn(write("w.hdr", std::string("ENVI\n\0\1", 7))),
    "w.hdr: has no data file beside it; expected w or w with .img, .dat, .raw, .bil, .bsq, .bip, "
    ".bin "
    "or .cube; put the data file beside the header");
}

msi::SpectralImageInfo description()
{
  msi::SpectralImageInfo info;
  info.width = Width;
  info.height = Height;
  info.bandNames = { "a", "b", "c", "d" };
  info.wavelengths = { 400, 450.5, 500, 550 };
  return info;
}

TEST_F(EnviImages, WriterStreamsRowsInEveryLayout)
{
  for (const auto interleave : { msi::Interleave::BSQ, msi::Interleave::BIL, msi::Interleave::BIP })
  {
    msi::EnviWriteOptions options;
    options.interleave = interleave;
    options.type = msi::SampleType::Int16;
    const auto writer = createEnviImage(path("out.img"), description(), options);
    const Numbers values = expected();
    writer->writeRows(1, values.data());
    // The other two rows from the bottom up.
    Numbers turned(values.begin() + 16, values.end());
    turned.insert(turned.end(), values.begin() + 8, values.begin() + 16);
    writer->writeRows(2, turned.data() + 8, -8);
    EXPECT_FALSE(std::filesystem::exists(path("out.img")) &&
      interleave == msi::Interleave::BSQ); // nothing yet, the first time
    writer->finish();
    const std::string name = interleave == msi::Interleave::BSQ ? "bsq"
      : interleave == msi::Interleave::BIL                      ? "bil"
                                                                : "bip";
    EXPECT_EQ(read("out.img"), samples(name)) << name;
    const auto file = openSpectralImage(path("out.hdr"));
    EXPECT_EQ(allOf(*file), values) << name;
    EXPECT_EQ(file->info().wavelengths, description().wavelengths);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(Folder), {}), 2) << name;
  }
}

TEST_F(EnviImages, WriterLeavesNothingBehindWhenItIsNotFinished)
{
  {
    const auto writer = createEnviImage(path("out.img"), description());
    writer->writeRows(2, expected().data());
    EXPECT_THROW(writer->writeRows(2, expected().data()), std::invalid_argument);
    EXPECT_THROW(writer->finish(), std::invalid_argument);
  }
  EXPECT_TRUE(std::filesystem::is_empty(Folder));
}

TEST_F(EnviImages, WriterRefusesWhatTheTypeCannotHold)
{
  msi::EnviWriteOptions options;
  options.type = msi::SampleType::UInt8;
  auto info = description();
  const auto write = [&](double value)
  {
    Numbers pixels(24, 1.0);
    pixels[10] = value;
    const auto writer = createEnviImage(path("o.img"), info, options);
    writer->writeRows(3, pixels.data());
  };
  EXPECT_EQ(errorOf([&] { write(300); }),
    "o.img: row 2: 300 is outside of uint8, 0 to 255; expected values that fit into the sample "
    "type; "
    "choose another type or reflectance scale factor");
  EXPECT_EQ(errorOf([&] { write(std::nan("")); }),
    "o.img: row 2: NaN cannot be stored as uint8 without a data ignore value; expected values that "
    "fit "
    "into the sample type; choose another type or reflectance scale factor");
  info.ignoreValue = 255;
  info.reflectanceScale = 100;
  EXPECT_EQ(errorOf([&] { write(std::nan("")); }), "");
  EXPECT_EQ(errorOf([&] { createEnviImage(path("no/o.img"), info); }),
    "no/o.img: cannot be written (No such file or directory); expected a writable folder with room "
    "in "
    "it; check the folder, its access rights and the free space");
  info.wavelengths.pop_back();
  EXPECT_THROW(createEnviImage(path("o.img"), info), std::invalid_argument);
}

TEST_F(EnviImages, WrittenNaNAndScaleComeBack)
{
  msi::EnviWriteOptions options;
  options.type = msi::SampleType::UInt16;
  auto info = description();
  info.ignoreValue = 65535;
  info.reflectanceScale = 10000;
  Numbers pixels(24, 0.1234);
  pixels[5] = std::nan("");
  const auto writer = createEnviImage(path("o"), info, options);
  writer->writeRows(3, pixels.data());
  writer->finish();
  const Numbers back = allOf(*openSpectralImage(path("o.img")));
  EXPECT_TRUE(std::isnan(back[5]));
  EXPECT_EQ(back[4], 0.1234);
}

} // namespace

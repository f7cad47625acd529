#include "Formats/Images/EnviHeader.h"

#include "Formats/FormatError.h"

#include <gtest/gtest.h>

#include <ostream>

namespace
{

using msi::parseEnviHeader;
using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

const std::string Minimal =
  "ENVI\nsamples = 4\nlines = 3\nbands = 2\ndata type = 4\ninterleave = bil\nbyte order = 0\n";

TEST(EnviHeader, ReadsTheUsualKeys)
{
  const auto header = parseEnviHeader("a.hdr",
    "ENVI\ndescription = {\n  Painting, left half\n}\nsamples = 4\nlines   = 3\nbands   = 2\n"
    "header offset = 16\nfile type = ENVI Standard\ndata type = 12\ninterleave = bsq\n"
    "sensor type = Unknown\nbyte order = 1\nwavelength units = Micrometers\n"
    "wavelength = {\n 0.45,\n 0.55}\nfwhm = {0.01, 0.02}\nbbl = {1, 0}\nband names = {blue, "
    "green}\n"
    "default bands = {2}\ndata ignore value = -1\nreflectance scale factor = 10000\n");
  EXPECT_EQ(header.info.width, 4);
  EXPECT_EQ(header.info.height, 3);
  EXPECT_EQ(header.info.bands(), 2);
  EXPECT_EQ(header.headerOffset, 16);
  EXPECT_EQ(header.type, msi::SampleType::UInt16);
  EXPECT_EQ(header.interleave, msi::Interleave::BSQ);
  EXPECT_EQ(header.byteOrder, msi::ByteOrder::Big);
  EXPECT_EQ(header.expectedFileSize(), 16 + 4 * 3 * 2 * 2);
  EXPECT_EQ(header.info.wavelengths, (Numbers{ 450, 550 }));
  EXPECT_EQ(header.info.fwhm, (Numbers{ 10, 20 }));
  EXPECT_EQ(header.info.goodBands, (std::vector<bool>{ true, false }));
  EXPECT_EQ(header.info.bandNames, (Names{ "blue", "green" }));
  EXPECT_EQ(header.info.displayBands, (std::vector<int>{ 1 }));
  EXPECT_EQ(header.info.ignoreValue, -1);
  EXPECT_EQ(header.info.reflectanceScale, 10000);
  EXPECT_EQ(header.info.quantity, "reflectance");
  EXPECT_EQ(header.info.metadata.at("description"), "Painting, left half");
  EXPECT_EQ(header.info.metadata.at("sensor type"), "Unknown");
  EXPECT_EQ(header.info.metadata.at("file type"), "ENVI Standard");
}

TEST(EnviHeader, ReadsOddSpacingCaseCommentsAndLineEnds)
{
  const auto header = parseEnviHeader("a.hdr",
    "ENVI  \r\n; a comment = no key\r\n\r\nSAMPLES=4\r\n  Lines =3 \r\nBands\t=\t2\r\nData   Type "
    "= 4\r\n"
    "INTERLEAVE = BIP\r\nbyte order=0\r\nwavelength = { 400 ,\r\n; inside\r\n\r\n  500 , "
    "}\r\nstray line\r\n");
  EXPECT_EQ(header.info.width, 4);
  EXPECT_EQ(header.interleave, msi::Interleave::BIP);
  EXPECT_EQ(header.info.wavelengths, (Numbers{ 400, 500 }));
  EXPECT_EQ(header.info.notes,
    (Names{ "the header states no wavelength units: nanometres were assumed",
      "line 14 was not understood: 'stray line'" }));
}

TEST(EnviHeader, BracesMayOpenOnTheNextLine)
{
  const auto header = parseEnviHeader("a.hdr",
    Minimal + "description =\n{two\nlines}\nwavelength =\n{\n400,\n500\n}\nsensor =\n; {\nstray\n");
  EXPECT_EQ(header.info.metadata.at("description"), "two lines");
  EXPECT_EQ(header.info.metadata.at("sensor"), "");
  EXPECT_EQ(header.info.wavelengths, (Numbers{ 400, 500 }));
  EXPECT_EQ(header.info.notes.back(), "line 18 was not understood: 'stray'");
}

TEST(EnviHeader, KeysThatNobodyReadsMayStandTwice)
{
  const auto header = parseEnviHeader("a.hdr", Minimal + "history = a\nhistory = b\nbands = 2\n");
  EXPECT_EQ(header.info.metadata.at("history"), "a");
}

TEST(EnviHeader, NamesOfBandsWithCommasAreNoted)
{
  const auto header = parseEnviHeader("a.hdr", Minimal + "band names = {a (1, 2), b}\n");
  EXPECT_EQ(header.info.bandNames, (Names{ "Band 1", "Band 2" }));
  EXPECT_EQ(header.info.notes, (Names{ "band names were left unread: 3 for 2 bands" }));
}

TEST(EnviHeader, NamesOfBandsTellWavelengths)
{
  const auto header =
    parseEnviHeader("a.hdr", Minimal + "band names = {Band 1 (450.5 nm), Band 2 (550 nm)}\n");
  EXPECT_EQ(header.info.wavelengths, (Numbers{ 450.5, 550 }));
  EXPECT_EQ(header.info.notes, (Names{ "wavelengths are those in the names of the bands" }));
  EXPECT_TRUE(parseEnviHeader("a.hdr", Minimal + "band names = {450 nm, panchromatic}\n")
                .info.wavelengths.empty());
}

TEST(EnviHeader, WavelengthsGivenElsewhereStandInForTheHeaders)
{
  msi::EnviHeaderOptions options;
  options.ownWavelengths = false;
  const auto header =
    parseEnviHeader("a.hdr", Minimal + "wavelength = {0, 0, 0}\nfwhm = {1}\n", options);
  EXPECT_TRUE(header.info.wavelengths.empty());
  EXPECT_TRUE(header.info.fwhm.empty());
}

Numbers wavelengthsWith(const std::string& lines, Names* notes = nullptr)
{
  const auto header = parseEnviHeader("a.hdr", Minimal + lines);
  if (notes != nullptr)
  {
    *notes = header.info.notes;
  }
  return header.info.wavelengths;
}

TEST(EnviHeader, WavelengthUnits)
{
  EXPECT_EQ(
    wavelengthsWith("wavelength = {400, 500}\nwavelength units = nm\n"), (Numbers{ 400, 500 }));
  EXPECT_EQ(
    wavelengthsWith("wavelength = {0.57, 0.58}\nwavelength units = um\n"), (Numbers{ 570, 580 }));
  EXPECT_EQ(wavelengthsWith("wavelength = {4000, 5000}\nwavelength units = Angstroms\n"),
    (Numbers{ 400, 500 }));
  EXPECT_EQ(wavelengthsWith("wavelength = {25000, 20000}\nwavelength units = Wavenumber\n"),
    (Numbers{ 400, 500 }));
  // c = 299792458 m/s: 500 nm are 599584.916 GHz.
  EXPECT_EQ(wavelengthsWith("wavelength = {749481.145, 599584.916}\nwavelength units = GHz\n"),
    (Numbers{ 400, 500 }));
  EXPECT_EQ(wavelengthsWith("wavelength = {749481145, 599584916}\nwavelength units = MHz\n"),
    (Numbers{ 400, 500 }));
  EXPECT_EQ(wavelengthsWith("wavelength = {4e-7, 5e-7}\nwavelength units = Meters\n"),
    (Numbers{ 400, 500 }));
  for (const char* micro : { "\xC2\xB5m", "\xCE\xBCm" })
  {
    EXPECT_EQ(
      wavelengthsWith("wavelength = {0.4, 0.5}\nwavelength units = " + std::string(micro) + "\n"),
      (Numbers{ 400, 500 }));
  }
  Names notes;
  EXPECT_EQ(wavelengthsWith("wavelength = {1, 1.5}\n", &notes), (Numbers{ 1000, 1500 }));
  EXPECT_EQ(wavelengthsWith("wavelength = {0.4, 0.5}\n", &notes), (Numbers{ 400, 500 }));
  EXPECT_EQ(notes, (Names{ "the header states no wavelength units: micrometres were assumed" }));
  EXPECT_TRUE(wavelengthsWith("wavelength = {1, 2}\nwavelength units = Index\n", &notes).empty());
  EXPECT_EQ(notes, (Names{ "the wavelengths are unknown: their unit is 'index'" }));
  EXPECT_TRUE(wavelengthsWith("wavelength = {1, 2}\nfwhm = {1, 1}\n", &notes).empty());
  EXPECT_EQ(notes, (Names{ "the wavelengths are unknown: their unit is not stated" }));
}

TEST(EnviHeader, WavelengthsThatTheirUnitMakesZeroOrInfinite)
{
  Names notes;
  EXPECT_TRUE(
    wavelengthsWith("wavelength = {25000, 2e60}\nwavelength units = Wavenumber\n", &notes).empty());
  EXPECT_EQ(notes, (Names{ "the wavelengths were forgotten: that of band 2 is 2e+60" }));
  EXPECT_TRUE(
    wavelengthsWith("wavelength = {1e303, 4e-7}\nwavelength units = Meters\n", &notes).empty());
  EXPECT_EQ(notes, (Names{ "the wavelengths were forgotten: that of band 1 is 1e+303" }));
}

TEST(EnviHeader, BandwidthsOfWavenumbers)
{
  // lambda = 1e7 / 25000 = 400 nm; d lambda = lambda dk / k = 400 * 250 / 25000 = 4 nm.
  const auto header = parseEnviHeader("a.hdr",
    Minimal + "wavelength = {25000, 20000}\nwavelength units = wavenumber\nfwhm = {250, 200}\n");
  EXPECT_DOUBLE_EQ(header.info.fwhm[0], 4.0);
  EXPECT_DOUBLE_EQ(header.info.fwhm[1], 5.0);
}

TEST(EnviHeader, WhatIsWrittenReadsBack)
{
  auto header = parseEnviHeader("a.hdr",
    Minimal +
      "wavelength = {400.1, 500.25}\nwavelength units = nm\nfwhm = {1.5, 2.5}\nbbl = {0, 1}\n"
      "band names = {a, b}\ndefault bands = {2, 1, 1}\ndata ignore value = -9999\n"
      "reflectance scale factor = 10000\ndescription = {x}\nsensor type = SPECIM IQ\nx start = "
      "7\n");
  const auto back = parseEnviHeader("b.hdr", enviHeaderText(header));
  EXPECT_EQ(back.info.wavelengths, header.info.wavelengths);
  EXPECT_EQ(back.info.fwhm, header.info.fwhm);
  EXPECT_EQ(back.info.goodBands, header.info.goodBands);
  EXPECT_EQ(back.info.bandNames, header.info.bandNames);
  EXPECT_EQ(back.info.displayBands, header.info.displayBands);
  EXPECT_EQ(back.info.ignoreValue, header.info.ignoreValue);
  EXPECT_EQ(back.info.reflectanceScale, header.info.reflectanceScale);
  EXPECT_EQ(back.info.metadata.at("description"), "x");
  EXPECT_EQ(back.info.metadata.at("sensor type"), "SPECIM IQ");
  EXPECT_EQ(
    back.info.metadata.count("x start"), 0u); // what is written may be another part of the image
  header.info.bandNames = { "brace } comma , end\n", "b" };
  EXPECT_EQ(parseEnviHeader("b.hdr", enviHeaderText(header)).info.bandNames,
    (Names{ "brace ) comma ; end", "b" }));
  // Names that hold no wavelength do not get one.
  auto unknown = parseEnviHeader("a.hdr", Minimal + "band names = {450{nm, 550{nm}\n");
  EXPECT_TRUE(unknown.info.wavelengths.empty());
  EXPECT_TRUE(parseEnviHeader("b.hdr", enviHeaderText(unknown)).info.wavelengths.empty());
  header.type = msi::SampleType::Int8;
  EXPECT_THROW(enviHeaderText(header), std::invalid_argument);
}

struct Malformed
{
  const char* name;
  std::string text;
  const char* message;
};

void PrintTo(const Malformed& c, std::ostream* out)
{
  *out << c.name;
}

class MalformedEnviHeader : public ::testing::TestWithParam<Malformed>
{
};

TEST_P(MalformedEnviHeader, IsToldByKeyAndLine)
{
  std::string message;
  try
  {
    parseEnviHeader("a.hdr", GetParam().text);
  }
  catch (const msi::FormatError& error)
  {
    message = error.what();
  }
  EXPECT_EQ(message, GetParam().message);
}

// Minimal with one key given another value, or left out.
std::string with(const std::string& key, const std::string& value)
{
  const std::size_t begin = Minimal.find("\n" + key + " ") + 1;
  const std::size_t end = Minimal.find('\n', begin) + 1;
  return Minimal.substr(0, begin) + (value.empty() ? "" : key + " = " + value + "\n") +
    Minimal.substr(end);
}

const Malformed Cases[] = {
  { "NoEnvi", "samples = 1\n",
    "a.hdr:1:1: the first line is 'samples = 1'; expected ENVI; name an ENVI header or its data "
    "file" },
  { "NoSamples", with("samples", ""),
    "a.hdr: the key 'samples' is missing; expected 'samples = ...'; add it to the header" },
  { "NoLines", with("lines", ""),
    "a.hdr: the key 'lines' is missing; expected 'lines = ...'; add it to the header" },
  { "NoBands", with("bands", ""),
    "a.hdr: the key 'bands' is missing; expected 'bands = ...'; add it to the header" },
  { "NoDataType", with("data type", ""),
    "a.hdr: the key 'data type' is missing; expected 'data type = ...'; add it to the header" },
  { "NoInterleave", with("interleave", ""),
    "a.hdr: the key 'interleave' is missing; expected 'interleave = ...'; add it to the header" },
  { "ZeroSamples", with("samples", "0"),
    "a.hdr:2:1: 'samples' is '0'; expected a whole number from 1 up; correct the header" },
  { "NegativeLines", with("lines", "-3"),
    "a.hdr:3:1: 'lines' is '-3'; expected a whole number from 1 up; correct the header" },
  { "FractionalBands", with("bands", "2.5"),
    "a.hdr:4:1: 'bands' is '2.5'; expected a whole number from 1 up; correct the header" },
  { "TextForSamples", with("samples", "many"),
    "a.hdr:2:1: 'samples' is 'many'; expected a whole number from 1 up; correct the header" },
  { "EmptySamples", with("samples", " "),
    "a.hdr:2:1: 'samples' is ''; expected a whole number from 1 up; correct the header" },
  { "HugeSamples", with("samples", "99999999999999999999"),
    "a.hdr:2:1: 'samples' is '99999999999999999999'; expected a whole number from 1 up; correct "
    "the "
    "header" },
  { "TooManySamples", with("samples", "9999999999"),
    "a.hdr:2:1: 'samples' is 9999999999; expected at most 1073741824; correct the header" },
  { "TooManyBands", with("bands", "2000000"),
    "a.hdr:4:1: 'bands' is 2000000; expected at most 1048576; correct the header" },
  { "TooLarge",
    "ENVI\nsamples = 1073741824\nlines = 1073741824\nbands = 1000000\ndata type = 5\ninterleave = "
    "bsq\n",
    "a.hdr:2:1: 'samples' times lines times bands is more than a file can hold; expected an image "
    "of "
    "less than 8 EiB; correct the header" },
  { "Complex", with("data type", "6"),
    "a.hdr:5:1: 'data type' is 6, complex numbers; expected 1, 2, 3, 4, 5, 12, 13, 14 or 15; "
    "convert "
    "the image to real numbers of these types" },
  { "DoubleComplex", with("data type", "9"),
    "a.hdr:5:1: 'data type' is 9, complex numbers; expected 1, 2, 3, 4, 5, 12, 13, 14 or 15; "
    "convert "
    "the image to real numbers of these types" },
  { "UnknownType", with("data type", "7"),
    "a.hdr:5:1: 'data type' is 7; expected 1, 2, 3, 4, 5, 12, 13, 14 or 15; convert the image to "
    "real "
    "numbers of these types" },
  { "UnknownInterleave", with("interleave", "BIX"),
    "a.hdr:6:1: 'interleave' is 'bix'; expected bsq, bil or bip; correct the header" },
  { "UnknownByteOrder", with("byte order", "2"),
    "a.hdr:7:1: 'byte order' is 2; expected 0 (little) or 1 (big); correct the header" },
  { "NegativeOffset", Minimal + "header offset = -1\n",
    "a.hdr:8:1: 'header offset' is '-1'; expected a whole number from 0 up; correct the header" },
  { "FewWavelengths", Minimal + "wavelength = {400}\n",
    "a.hdr:8:1: 'wavelength' has 1 values; expected 2, one for each band; complete the list or "
    "remove "
    "the key" },
  { "TextInWavelengths", Minimal + "wavelength = {400, five}\n",
    "a.hdr:8:1: 'wavelength' holds 'five'; expected numbers with commas between them; correct the "
    "header" },
  { "MissingComma", Minimal + "wavelength = {400 500}\n",
    "a.hdr:8:1: 'wavelength' holds '400 500'; expected numbers with commas between them; correct "
    "the "
    "header" },
  { "ManyWidths", Minimal + "fwhm = {1, 2, 3}\n",
    "a.hdr:8:1: 'fwhm' has 3 values; expected 2, one for each band; complete the list or remove "
    "the "
    "key" },
  { "FewFlags", Minimal + "bbl = {1}\n",
    "a.hdr:8:1: 'bbl' has 1 values; expected 2, one for each band; complete the list or remove the "
    "key" },
  { "BraceWithoutEnd", Minimal + "wavelength = {400,\n 500\n",
    "a.hdr:8:1: the value of 'wavelength' has no end; expected a closing brace; the header seems "
    "to be "
    "cut off" },
  { "KeyTwice", Minimal + "samples = 5\n",
    "a.hdr:8:1: 'samples' stands here a second time with another value; expected the value of line "
    "2, "
    "'4'; remove one of the lines" },
  { "TextForIgnoreValue", Minimal + "data ignore value = none\n",
    "a.hdr:8:1: 'data ignore value' is 'none'; expected a number; correct the header" },
  { "ZeroScale", Minimal + "reflectance scale factor = 0\n",
    "a.hdr:8:1: 'reflectance scale factor' is 0; expected a positive number; correct the header" },
  { "Compressed", Minimal + "file compression = 1\n",
    "a.hdr:8:1: 'file compression' says that the data are compressed; expected 0; unpack the data "
    "file "
    "and set the key to 0" },
  { "FrameOffsets", Minimal + "major frame offsets = {8, 0}\n",
    "a.hdr:8:1: 'major frame offsets' are not zero; expected {0, 0}; write the image without frame "
    "offsets" },
  { "Library", Minimal + "file type = ENVI Spectral Library\n",
    "a.hdr:8:1: 'file type' is 'ENVI Spectral Library'; expected 'ENVI Standard', an image of "
    "samples; "
    "read it as a sample table, or name an image" },
  { "Classification", Minimal + "file type = ENVI Classification\n",
    "a.hdr:8:1: 'file type' is 'ENVI Classification'; expected 'ENVI Standard', an image of "
    "samples; read it as a "
    "label image, or name an image" },
};

INSTANTIATE_TEST_SUITE_P(Envi, MalformedEnviHeader, ::testing::ValuesIn(Cases),
  [](const auto& tested) { return tested.param.name; });

} // namespace

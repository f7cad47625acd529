#include "Formats/SampleTable.h"

#include "Support/formats/TestFiles.h"

#include <lcms2.h>

#include <memory>

namespace
{

using msi::readSampleTable;
using msi::SampleTable;

class Cgats : public msi::testing::TemporaryFolder
{
protected:
  SampleTable table(const std::string& content) const
  {
    return readSampleTable(write("t.ti3", content));
  }
  std::string errorIn(const std::string& content) const
  {
    return errorOf([&] { table(content); });
  }
};

const std::string Small = "CTI3   \n\nDESCRIPTOR \"a # b\" # comment\nKEYWORD \"SPECTRAL_BANDS\"\n"
                          "NUMBER_OF_FIELDS 4\nBEGIN_DATA_FORMAT\n"
                          "SAMPLE_ID SAMPLE_NAME SPEC_410 SPEC_400\nEND_DATA_FORMAT\n\n"
                          "NUMBER_OF_SETS 2\nBEGIN_DATA\n";

TEST_F(Cgats, ReadsFieldsAndSets)
{
  const SampleTable t = table(Small + "001 \"dark skin\" 0.2 0.1\n1e5 'x'\n\t0.4 0.3\nEND_DATA\n");
  EXPECT_EQ(t.sampleNames(), (std::vector<std::string>{ "dark skin", "x" }));
  EXPECT_EQ(t.findMetadata("SAMPLE_ID")->text, (std::vector<std::string>{ "001", "1e5" }));
  EXPECT_EQ(t.reflectance, (Eigen::Matrix2d() << 0.1, 0.3, 0.2, 0.4).finished());
}

TEST_F(Cgats, DecimalCommasCount)
{
  const SampleTable t = table(Small + "1 a 0,2 0,1\n2 b 0,4 0.3\nEND_DATA\n");
  EXPECT_EQ(t.reflectance, (Eigen::Matrix2d() << 0.1, 0.3, 0.2, 0.4).finished());
}

TEST_F(Cgats, TakesTheTableWithSpectra)
{
  const SampleTable t =
    table("CTI3\nBEGIN_DATA_FORMAT\nSAMPLE_ID RGB_R\nEND_DATA_FORMAT\nBEGIN_DATA\n"
          "A1 1\nEND_DATA\nCAL\n" +
      Small + "1 a 0.2 0.1\n2 b 0.4 0.3\nEND_DATA\n");
  EXPECT_EQ(t.sampleCount(), 2);
}

TEST_F(Cgats, ErrorsNameTheirPlace)
{
  EXPECT_EQ(errorIn(Small + "1 a 0.2 0.1\n2 b 0.4\nEND_DATA\n"),
    "t.ti3:13:1: the data are 7 values, and 4 fields are named; expected 4 values in each set; "
    "complete the set that is short");
  EXPECT_EQ(errorIn(Small + "1 a 0.2 0.1\nEND_DATA\n"),
    "t.ti3:10:16: NUMBER_OF_SETS is 2; expected 1, the number found; correct the "
    "number or complete the file");
  EXPECT_EQ(errorIn(Small + "1 a 0.2 0.1\n2 b 0.4"),
    "t.ti3:11:1: BEGIN_DATA has no end; expected END_DATA; the file seems to be cut off");
  EXPECT_EQ(errorIn(Small + "1 a 0.2 0.1\n2 b zero 0.1\nEND_DATA\n"),
    "t.ti3:13:5: 'zero' is no number in column 'SPEC_410'; expected a reflectance; fill in the "
    "value "
    "or remove the row");
  EXPECT_EQ(errorIn("CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400\nEND_DATA_FORMAT\n"),
    "t.ti3: has no BEGIN_DATA; expected a CGATS file with a data section; the file seems to be cut "
    "off");
  EXPECT_EQ(errorIn("CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400\n"),
    "t.ti3:2:1: BEGIN_DATA_FORMAT has no end; expected END_DATA_FORMAT; the file seems to be cut "
    "off");
  EXPECT_EQ(errorIn("CGATS.17\nNUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400\n"
                    "END_DATA_FORMAT\n"),
    "t.ti3:2:18: NUMBER_OF_FIELDS is 3; expected 2, the number found; correct "
    "the "
    "number or complete the file");
  EXPECT_EQ(errorIn("CGATS.17\nBEGIN_DATA\n1 2\nEND_DATA\n"),
    "t.ti3:2:1: BEGIN_DATA comes without field names; expected BEGIN_DATA_FORMAT with field names "
    "before it; check how the file was written");
  EXPECT_EQ(errorIn("CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID RGB_R\nEND_DATA_FORMAT\nBEGIN_DATA\n"
                    "A1 1\nEND_DATA\n"),
    "t.ti3:3:1: no column is a reflectance or a response (the columns are sample, RGB_R); expected "
    "columns named by wavelength in nm (R400, 400nm, SPEC_400, ...) or C and a number (C1, C400); "
    "rename the columns");
}

TEST_F(Cgats, ReadsAnArgyllFile)
{
  MSI_MEASURED_DATA(file, "files/cc24_ref.cie");
  const SampleTable t = readSampleTable(file);
  EXPECT_EQ(t.sampleCount(), 24);
  // 71 bands from 380 to 730 nm are announced in the file, and 74 fields follow the seven others.
  EXPECT_EQ(t.wavelengths->front(), 380);
  EXPECT_EQ(t.wavelengths->step(), 5);
  EXPECT_EQ(t.sampleNames()[0], "A01");
  EXPECT_DOUBLE_EQ(t.reflectance(0, 0), 0.0547500);
  EXPECT_EQ(t.notes[0], "reflectance was in percent: divided by 100");
  EXPECT_EQ(t.findMetadata("XYZ_X")->numbers()[0], 11.5939);
}

SampleTable small()
{
  SampleTable t;
  t.metadata = { { "sample", { "dark skin", "A1" } }, { "my note", { "x", "say \"y\"" } } };
  t.wavelengths = msi::WavelengthGrid({ 400, 410.5 });
  t.reflectance = (Eigen::Matrix2d() << 0.1, 1.0 / 3, 0.25, 0.7).finished();
  t.channelNames = { "C1" };
  t.responses = (Eigen::MatrixXd(1, 2) << 0.5, 2.0 / 3).finished();
  return t;
}

TEST_F(Cgats, RoundTripIsExact)
{
  const SampleTable t = small();
  writeSampleTableCgats(path("out.ti3"), t);
  const SampleTable back = readSampleTable(path("out.ti3"));
  EXPECT_EQ(back.reflectance, t.reflectance);
  EXPECT_EQ(back.responses, t.responses);
  EXPECT_EQ(*back.wavelengths, *t.wavelengths);
  EXPECT_EQ(back.sampleNames(), t.sampleNames());
  EXPECT_EQ(back.findMetadata("my_note")->text[1], "say \"y\"");
}

TEST_F(Cgats, LittleCmsReadsWhatIsWritten)
{
  writeSampleTableCgats(path("out.ti3"), small());
  const std::unique_ptr<void, void (*)(cmsHANDLE)> sheet(
    cmsIT8LoadFromFile(nullptr, path("out.ti3").c_str()), cmsIT8Free);
  ASSERT_NE(sheet, nullptr);
  EXPECT_STREQ(cmsIT8GetSheetType(sheet.get()), "CGATS.17");
  EXPECT_DOUBLE_EQ(cmsIT8GetDataDbl(sheet.get(), "dark skin", "SPECTRAL_NM400"), 0.1);
  EXPECT_NEAR(cmsIT8GetDataDbl(sheet.get(), "A1", "SPECTRAL_NM400"), 1.0 / 3, 1e-9);
  EXPECT_NEAR(cmsIT8GetDataDbl(sheet.get(), "A1", "C1"), 2.0 / 3, 1e-9);
}

} // namespace

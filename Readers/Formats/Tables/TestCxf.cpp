#include "Formats/SampleTable.h"

#include "Support/formats/TestFiles.h"

namespace
{

using msi::readSampleTable;
using Names = std::vector<std::string>;

class Cxf : public msi::testing::TemporaryFolder
{
protected:
  static std::string document(
    const std::string& objects, const std::string& range = R"(StartWL="400" Increment="20")")
  {
    return R"(<?xml version="1.0" encoding="UTF-8"?>
<cc:CxF xmlns:cc="http://colorexchangeformat.com/CxF3-core">
<cc:Resources><cc:ObjectCollection>
)" + objects +
      R"(
</cc:ObjectCollection><cc:ColorSpecificationCollection><cc:ColorSpecification Id="CS1"><cc:MeasurementSpec>
<cc:WavelengthRange )" +
      range + R"(/></cc:MeasurementSpec></cc:ColorSpecification></cc:ColorSpecificationCollection>
</cc:Resources></cc:CxF>
)";
  }
  static std::string object(const std::string& name, const std::string& spectrum)
  {
    return "<cc:Object ObjectType=\"Target\" Name=\"" + name + "\" Id=\"7\"><cc:ColorValues>" +
      spectrum + "</cc:ColorValues></cc:Object>\n";
  }
  static std::string spectrum(const std::string& values, const std::string& attributes = {})
  {
    return "<cc:ReflectanceSpectrum ColorSpecification=\"CS1\"" + attributes + ">" + values +
      "</cc:ReflectanceSpectrum>";
  }
  std::string errorIn(const std::string& content) const
  {
    return errorOf([&] { readSampleTable(write("a.cxf", content)); });
  }
};

TEST_F(Cxf, ReadsSpectraOfObjects)
{
  const auto table = readSampleTable(write("a.cxf",
    document(object("red", spectrum("0.1 0.2\n 0.3")) + object("", spectrum("0.4 0.5 0.6")) +
      object("lab", "<cc:ColorCIELab/>") + object("two", spectrum("1 1 1") + spectrum("0 0 0")))));
  EXPECT_EQ(table.wavelengths->values(), (std::vector<double>{ 400, 420, 440 }));
  EXPECT_EQ(table.sampleNames(), (Names{ "red", "7", "two" }));
  EXPECT_EQ(table.reflectance.col(1), Eigen::Vector3d(0.4, 0.5, 0.6));
  EXPECT_EQ(table.reflectance.col(2), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(table.notes,
    (Names{ "1 object without a spectrum was left out",
      "1 object has several spectra: the first was read" }));
}

TEST_F(Cxf, EncodingsOtherThanUtf8)
{
  std::string latin1 = document(object("gr\xFCn", spectrum("0.1 0.2 0.3")));
  latin1.replace(latin1.find("UTF-8"), 5, "ISO-8859-1");
  EXPECT_EQ(readSampleTable(write("a.cxf", latin1)).sampleNames(), (Names{ "gr\xC3\xBCn" }));
  std::string wide = "\xFF\xFE";
  for (const char c : document(object("x", spectrum("0.1 0.2 0.3"))))
  {
    wide += { c, '\0' };
  }
  wide.replace(wide.find("8"), 2,
    std::string("1\0"
                "6\0",
      4));
  EXPECT_EQ(readSampleTable(write("a.cxf", wide)).sampleNames(), (Names{ "x" }));
}

TEST_F(Cxf, TheStartOfTheSpectrumCounts)
{
  const auto table = readSampleTable(
    write("a.cxf", document(object("red", spectrum("0.1 0.2", " StartWL=\"380\"")))));
  EXPECT_EQ(table.wavelengths->values(), (std::vector<double>{ 380, 400 }));
}

TEST_F(Cxf, ErrorsNameTheirPlace)
{
  EXPECT_EQ(errorIn("<a>\n<b></a>"),
    "a.cxf:2:6: this is no XML (Start-end tags mismatch); expected a CxF3 file; the file seems to "
    "be "
    "cut off or damaged");
  EXPECT_EQ(errorIn(document("").substr(0, 200)).substr(0, 30), "a.cxf:5:63: this is no XML (Er");
  EXPECT_EQ(
    errorIn("<svg/>"), "a.cxf:1:2: the root element is 'svg'; expected CxF; name a CxF3 file");
  EXPECT_EQ(errorIn(document(object("lab", "<cc:ColorCIELab/>"))),
    "a.cxf: holds no object with a ReflectanceSpectrum; expected measured spectra; export the "
    "spectra, "
    "not only color values");
  EXPECT_EQ(errorIn(document(object("red", spectrum("0.1 x")))),
    "a.cxf:4:67: 'x' is no number of a spectrum; expected numbers with blanks between them; "
    "correct "
    "the spectrum");
  EXPECT_EQ(errorIn(document(object("red", spectrum(" ")))),
    "a.cxf:4:67: the spectrum is empty; expected one number for each wavelength; remove the object "
    "or "
    "complete it");
  EXPECT_EQ(errorIn(document(object("red", spectrum("0.1 0.2")) + object("b", spectrum("0.1")))),
    "a.cxf:5:65: sample 'b' has 1 wavelengths from 400 to 400 nm; expected 2 wavelengths from 400 "
    "to "
    "420 nm, as 'red' has; give all samples the same wavelengths");
  EXPECT_EQ(errorIn(document(object("red", spectrum("0.1 0.2")), "StartWL=\"400\"")),
    "a.cxf:4:67: the spectrum states no Increment; expected a ColorSpecification with "
    "WavelengthRange "
    "StartWL and Increment; complete the file");
  EXPECT_EQ(errorIn(document(object("red", spectrum("0.1 0.2")), "StartWL=\"four\"")),
    "a.cxf:7:2: StartWL is 'four'; expected a wavelength in nm; correct the attribute");
  EXPECT_EQ(errorIn(document(object("red", spectrum("0.1 0.2")), "StartWL=\"40\" Increment=\"1\"")),
    "a.cxf:4:67: wavelength 1 is 40 nm; expected a value from 100 to 20000 nm; state the "
    "wavelengths "
    "in nanometres");
}

} // namespace

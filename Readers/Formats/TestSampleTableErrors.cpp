#include "Formats/SampleTable.h"

#include "Support/formats/TestFiles.h"

#include <ostream>

namespace
{

using msi::readSampleTable;
using msi::SampleTableOptions;

struct Case
{
  const char* name;
  std::string content;
  const char* message;
};

void PrintTo(const Case& c, std::ostream* out)
{
  *out << c.name;
}

class SampleTableErrors
  : public msi::testing::TemporaryFolder
  , public ::testing::WithParamInterface<Case>
{
};

TEST_P(SampleTableErrors, NamePlaceExpectationAndRemedy)
{
  const std::string file = write("t.csv", GetParam().content);
  EXPECT_EQ(errorOf([&] { readSampleTable(file); }), GetParam().message);
}

const Case Cases[] = {
  { "NoSpectralColumn", "sample,medium\na,b\n",
    "t.csv:1:1: no column is a reflectance or a response (the columns are sample, medium); "
    "expected "
    "columns named by wavelength in nm (R400, 400nm, SPEC_400, ...) or C and a number (C1, C400); "
    "rename the columns" },
  { "ShortRow", "sample,R400,R410\na,0.1,0.2\nb,0.3\nc,0.1,0.2\n",
    "t.csv:3:3: this row has 2 cells; expected 3, as line 1 has; complete the row or remove it" },
  { "LongRow", "sample,R400\na,0.1,0.2\n",
    "t.csv:2:7: this row has 3 cells; expected 2, as line 1 has; complete the row or remove it" },
  { "CutOff", "sample,R400,R410\na,0.1,0.2\nb,0.",
    "t.csv:3:3: this row has 2 cells; expected 3, as line 1 has; the file seems to be cut off" },
  { "TextInNumber", "# c\n\nsample,R400,R410\na,0.1,0.2\nb,0.1, n.a. \n",
    "t.csv:5:8: 'n.a.' is no number in column 'R410'; expected a reflectance; fill in the value or "
    "remove the row" },
  { "TextInResponse", "sample,C1\na,\"x\"\n",
    "t.csv:2:3: 'x' is no number in column 'C1'; expected a response; fill in the value or remove "
    "the row" },
  { "EmptyCell", "sample,R400,R410\na,,0.2\n",
    "t.csv:2:3: empty cell in column 'R400'; expected a reflectance; fill in the value or remove "
    "the row" },
  { "NotANumber", "sample,R400,R410\na,0.1,NaN\n",
    "t.csv:2:7: 'NaN' is not finite in column 'R410'; expected a reflectance; fill in the value or "
    "remove the row" },
  { "Infinite", "sample,R400\na,inf\n",
    "t.csv:2:3: 'inf' is not finite in column 'R400'; expected a reflectance; fill in the value or "
    "remove the row" },
  { "DecimalCommaBetweenCommas", "sample,R400,R410\na,\"0,1\",0.2\n",
    "t.csv:2:3: '0,1' is no number in column 'R400'; expected a reflectance; fill in the value or "
    "remove the row" },
  { "PercentAmongFactors", "sample,R400,R410\na,0.1,0.2\nb,10,20\nc,0.3,0.4\n",
    "t.csv:3:1: sample 'b' has a largest reflectance of 20, while 2 of 3 samples look like "
    "factors; "
    "expected either percent or factors in the whole file; bring all samples to one unit, or state "
    "the unit in the options" },
  { "FactorsAmongPercent", "sample,R400\na,10\nb,20\nc,0.3\n",
    "t.csv:4:1: sample 'c' has a largest reflectance of 0.3, while 2 of 3 samples look like "
    "percent; "
    "expected either percent or factors in the whole file; bring all samples to one unit, or state "
    "the unit in the options" },
  { "DuplicateWavelength", "sample,R400,R410,400nm\na,1,1,1\n",
    "t.csv:1:18: columns 'R400' and '400nm' name the same wavelength; expected one column for each "
    "wavelength; remove or rename one of them" },
  { "DuplicateChannel", "sample,C1,C01\na,1,1\n",
    "t.csv:1:11: columns 'C1' and 'C01' name the same channel; expected one column for each "
    "channel; "
    "remove or rename one of them" },
  { "DuplicateMetadata", "sample,Sample,R400\na,b,1\n",
    "t.csv:1:8: two columns are named 'Sample'; expected different names; rename or remove one of "
    "them" },
  { "UnnamedColumn", "sample,,R400\na,b,1\n",
    "t.csv:1:8: column 2 has no name; expected a name in every column of the header; name the "
    "column "
    "or remove it" },
  { "NoSamples", "sample,R400,R410\n\n",
    "t.csv:1:1: there is a header but no sample; expected one row a sample below the header; check "
    "how the file was written" },
  { "OnlyComments", "# a\n# b\n",
    "t.csv: holds no table, only comments; expected a header line and rows; name another file" },
  { "Empty", "",
    "t.csv: is empty; expected a sample table (CSV, CGATS, CxF3 or MAT); check how it was "
    "written" },
  { "OnlyBlanks", "\r\n \n",
    "t.csv: is empty; expected a sample table (CSV, CGATS, CxF3 or MAT); check how it was "
    "written" },
  { "Binary", std::string("sample,R400\n\0\x01\x02", 15),
    "t.csv: is a binary file; expected a sample table (CSV, CGATS, CxF3 or MAT); name another "
    "file" },
  { "DamagedUtf16", std::string("\xFF\xFEs\0\x00\xD8", 6),
    "t.csv: is damaged UTF-16 text; expected a sample table (CSV, CGATS, CxF3 or MAT) in UTF-8; "
    "save it as "
    "UTF-8" },
  { "QuoteInsideField", "sample,R400\na\"b,0.1\n",
    "t.csv:2:2: a quote stands inside a field; expected quotes around whole fields, inner quotes "
    "doubled; correct this line" },
  { "QuoteWithoutEnd", "sample,R400\na,0.1\n\"b,0.1\n",
    "t.csv:3:1: a quoted field has no end; expected a closing quote; the file seems to be cut off, "
    "or "
    "this quote is one too many" },
  { "MatrixFitsNoSide", "0.1 0.2\n0.3 0.4\n0.5 0.6\n",
    "t.csv: the matrix is 3 x 2; expected one side of 31 wavelengths (400..700 nm); state the "
    "wavelengths of the matrix" },
  { "RaggedMatrix", "0.1 0.2\n0.3\n",
    "t.csv:2:1: this row has 1 cell; expected 2, as line 1 has; complete the row or remove it" },
  { "TextInMatrix", "0.1,0.2\n0.3,x\n",
    "t.csv:2:5: 'x' is no number; expected a number; fill in the value or remove the row" },
  { "MissingMark", "sample,R400,R410\na,0.1,0.2\nb,-9999,0.2\n",
    "t.csv:3:1: sample 'b' has a reflectance factor at 400 nm of -9999; expected -1 to 100, where "
    "1 is the perfect "
    "white; remove the sample if this marks a missing value" },
  { "MissingMarkInPercent", "sample,R400,R410\na,10,20\nb,-1e9,20\n",
    "t.csv:3:1: sample 'b' has a reflectance factor at 400 nm of -1e+07; expected -1 to 100, "
    "where 1 is the perfect "
    "white; remove the sample if this marks a missing value" },
  { "MissingMarkInResponses", "sample,R400,C1,C2\na,0.1,0.2,0.3\nb,0.1,0.2,-9999\n",
    "t.csv:3:1: sample 'b' has a response in channel C2 of -9999; expected -10 to 1000, as the "
    "other responses are; "
    "remove the sample if this marks a missing value" },
  { "CurveTwice", "wavelength,a\n400,1\n410,1\n400,1\n",
    "t.csv:4:1: wavelength 400 stands here a second time; expected each wavelength once; remove "
    "one "
    "of the rows" },
};

INSTANTIATE_TEST_SUITE_P(Csv, SampleTableErrors, ::testing::ValuesIn(Cases),
  [](const auto& tested) { return tested.param.name; });

class SampleTableFileErrors : public msi::testing::TemporaryFolder
{
};

TEST_F(SampleTableFileErrors, MoreColumnsThanAnySpectrumHas)
{
  std::string header = "sample";
  std::string row = "a";
  for (int i = 0; i < 70000; ++i)
  {
    header += ",C" + std::to_string(i + 1);
    row += ",0.5";
  }
  const std::string message =
    errorOf([&] { readSampleTable(write("t.csv", header + "\n" + row + "\n")); });
  EXPECT_NE(message.find("the table has 70001 columns; expected at most 65536"), std::string::npos)
    << message;
}

TEST_F(SampleTableFileErrors, MissingFile)
{
  EXPECT_EQ(errorOf([&] { readSampleTable(path("none.csv")); }),
    "none.csv: cannot be read (No such file or directory); expected a readable file; check the "
    "name "
    "and the access rights");
}

TEST_F(SampleTableFileErrors, Folder)
{
  std::filesystem::create_directory(path("d"));
  EXPECT_EQ(errorOf([&] { readSampleTable(path("d")); }),
    "d: is a folder; expected a file; name a file in it");
}

TEST_F(SampleTableFileErrors, CountsThatDiffer)
{
  SampleTableOptions options;
  options.wavelengths = msi::WavelengthGrid({ 500, 600 });
  options.responseFile = write("c.txt", "1 2 3 4\n5 6 7 8\n");
  const auto reflectance = write("r.txt", "0.1 0.2 0.3\n0.4 0.5 0.6\n");
  EXPECT_EQ(errorOf([&] { readSampleTable(reflectance, options); }),
    "c.txt: the matrix is 2 x 4; expected one side of 3, the samples of r.txt; give reflectances "
    "and "
    "responses of the same samples");
  write("c.txt", "C1 C2\n1 2\n");
  EXPECT_EQ(errorOf([&] { readSampleTable(reflectance, options); }),
    "c.txt:1:1: the response file has a header; expected numbers only, beside a reflectance file "
    "of "
    "numbers only; put reflectance and responses into one table with a header");
  options.responseFile = path("r.txt");
  EXPECT_EQ(errorOf([&] { readSampleTable(write("t.csv", "sample,R400\na,1\n"), options); }),
    "t.csv:1:1: the table has a header, and a response file was given; expected responses as "
    "columns "
    "C1, C2, ...; leave the response file out, or give a reflectance matrix without a header");
}

} // namespace

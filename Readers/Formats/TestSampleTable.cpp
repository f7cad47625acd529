#include "Formats/SampleTable.h"

#include "Support/formats/TestFiles.h"

#include <cmath>

namespace
{

using msi::readSampleTable;
using msi::SampleTable;
using msi::SampleTableOptions;

class SampleTables : public msi::testing::TemporaryFolder
{
protected:
  SampleTable table(const std::string& content) const
  {
    return readSampleTable(write("t.csv", content));
  }
};

TEST_F(SampleTables, KeepsMetadataReflectanceAndResponsesApart)
{
  const SampleTable t = table("sample,medium,x,note,R400,R410,C400,C420\n"
                              "a,paper,1.5,\"first, best\",0.1,0.2,0.3,0.4\n"
                              "b,cotton,,,0.5,0.6,0.7,0.8\n");
  ASSERT_EQ(t.sampleCount(), 2);
  ASSERT_EQ(t.metadata.size(), 4u);
  EXPECT_EQ(t.sampleNames(), (std::vector<std::string>{ "a", "b" }));
  EXPECT_EQ(t.findMetadata("NOTE")->text[0], "first, best");
  const auto x = t.findMetadata("x")->numbers();
  EXPECT_EQ(x[0], 1.5);
  EXPECT_TRUE(std::isnan(x[1]));
  EXPECT_TRUE(t.findMetadata("medium")->numbers().empty());
  EXPECT_EQ(t.wavelengths->values(), (std::vector<double>{ 400, 410 }));
  EXPECT_EQ(t.reflectance, (Eigen::Matrix2d() << 0.1, 0.5, 0.2, 0.6).finished());
  EXPECT_EQ(t.channelNames, (std::vector<std::string>{ "C400", "C420" }));
  EXPECT_EQ(t.channelWavelengths->values(), (std::vector<double>{ 400, 420 }));
  EXPECT_EQ(t.responses, (Eigen::Matrix2d() << 0.3, 0.7, 0.4, 0.8).finished());
  EXPECT_TRUE(t.notes.empty());
}

TEST_F(SampleTables, KeepsDisplacementsOfChannelsAsTheyAre)
{
  const SampleTable t =
    table("channel,x,y,magnification,rotation\n400,0.25,-1,0.001,0\n500,0,0,0,0\n");
  ASSERT_EQ(t.metadata.size(), 5u);
  EXPECT_EQ(t.findMetadata("channel")->text[0], "400");
  EXPECT_EQ(t.findMetadata("y")->numbers()[0], -1.0);
  EXPECT_EQ(t.reflectance.size(), 0);
  EXPECT_EQ(t.responses.size(), 0);
}

TEST_F(SampleTables, KnowsEverySpellingOfAWavelengthInAnyOrder)
{
  const SampleTable t =
    table("SPECTRAL_NM_460,nm450,400,R_405.5,410nm,SPEC_420,SPECTRAL_NM430,r440,X470\n"
          "0.8,0.7,0.1,0.2,0.3,0.4,0.5,0.6,0.9\n");
  EXPECT_EQ(t.wavelengths->values(),
    (std::vector<double>{ 400, 405.5, 410, 420, 430, 440, 450, 460, 470 }));
  EXPECT_EQ(t.reflectance.col(0).transpose(),
    (Eigen::RowVectorXd(9) << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9).finished());
}

TEST_F(SampleTables, TextOfSpreadsheetPrograms)
{
  const std::string latin1 = "sample;400;410\nGr\xFCn;0,1;0,2\n";
  EXPECT_EQ(table(latin1).sampleNames(), (std::vector<std::string>{ "Gr\xC3\xBCn" }));
  std::string little = "\xFF\xFE";
  std::string big = "\xFE\xFF";
  for (const char c : latin1)
  {
    little += { c, '\0' };
    big += { '\0', c };
  }
  EXPECT_EQ(table(little).sampleNames(), (std::vector<std::string>{ "Gr\xC3\xBCn" }));
  EXPECT_EQ(table(big).sampleNames(), (std::vector<std::string>{ "Gr\xC3\xBCn" }));
  const SampleTable stated = table("sep=|\r\nsample|400|410\r\na;b|0,1|0,2\r\n");
  EXPECT_EQ(stated.sampleNames(), (std::vector<std::string>{ "a;b" }));
  EXPECT_EQ(stated.reflectance.col(0), Eigen::Vector2d(0.1, 0.2));
}

TEST_F(SampleTables, NumbersOfChannelsAreIndicesBelow200)
{
  const SampleTable t = table("sample,C2,C10,C1\na,2,10,1\n");
  EXPECT_EQ(t.channelNames, (std::vector<std::string>{ "C1", "C2", "C10" }));
  EXPECT_FALSE(t.channelWavelengths.has_value());
  EXPECT_EQ(t.responses, Eigen::Vector3d(1, 2, 10));
  EXPECT_FALSE(t.hasReflectance());
}

TEST_F(SampleTables, ReadsWhatSpreadsheetsWrite)
{
  // Byte order mark, semicolons, decimal commas, CRLF, comments, blank lines, empty columns and rows.
  const SampleTable t = table("\xEF\xBB\xBF# measured today\r\n\r\n\"sample\";R400;R400,5;;\r\n"
                              "  \"a \"\"x\"\"\" ;0,25;0,5;;\r\n;;;;\r\n# end\r\nb;1e-1;+0.75;;");
  EXPECT_EQ(t.sampleNames(), (std::vector<std::string>{ "a \"x\"", "b" }));
  EXPECT_EQ(t.wavelengths->values(), (std::vector<double>{ 400, 400.5 }));
  EXPECT_EQ(t.reflectance, (Eigen::Matrix2d() << 0.25, 0.1, 0.5, 0.75).finished());
}

TEST_F(SampleTables, ReadsTabsAndBlanks)
{
  EXPECT_EQ(table("sample\t400\t410\na b\t0,1\t0.2\n").reflectance, Eigen::Vector2d(0.1, 0.2));
  EXPECT_EQ(table("sample  400   410\n\n a   0.1 0.2  \n").reflectance, Eigen::Vector2d(0.1, 0.2));
}

TEST_F(SampleTables, AQuotedFieldMayHoldLineEnds)
{
  const SampleTable t = table("sample,R400\n\"two\n# lines\",0.5\nb,0.25\n");
  EXPECT_EQ(t.sampleNames(), (std::vector<std::string>{ "two\n# lines", "b" }));
  EXPECT_EQ(t.reflectance, Eigen::RowVector2d(0.5, 0.25));
}

TEST_F(SampleTables, OneRowAWavelengthIsTurned)
{
  const SampleTable t = table("wavelength,white,gray\n410,0.9,0.4\n400,0.8,0.3\n");
  EXPECT_EQ(t.sampleNames(), (std::vector<std::string>{ "white", "gray" }));
  EXPECT_EQ(t.reflectance, (Eigen::Matrix2d() << 0.8, 0.3, 0.9, 0.4).finished());
  EXPECT_EQ(t.notes.back(), "the file has one row a wavelength: its columns were taken as samples");
}

TEST_F(SampleTables, PercentIsRecognizedAndSaid)
{
  const SampleTable t = table("sample,R400,R410\na,50,60\nb,3,4\nc,80,81\nblack,0.7,0.8\n");
  EXPECT_EQ(t.reflectance.col(0), Eigen::Vector2d(0.5, 0.6));
  EXPECT_EQ(t.reflectance.col(3), Eigen::Vector2d(0.7 / 100, 0.8 / 100));
  EXPECT_EQ(t.notes.back(),
    "reflectance was in percent: divided by 100 (1 of 4 samples stay below 2 percent; the darkest "
    "is "
    "sample 'black')");
}

TEST_F(SampleTables, FluorescentFactorsStayFactors)
{
  const SampleTable t = table("sample,R400,R410\na,1.3,1.9\nb,0.1,0.2\n");
  EXPECT_EQ(t.reflectance.col(0), Eigen::Vector2d(1.3, 1.9));
  EXPECT_TRUE(t.notes.empty());
}

TEST_F(SampleTables, TheUnitCanBeStated)
{
  const auto path = write("t.csv", "sample,R400\na,0.5\nb,1.5\n");
  SampleTableOptions options;
  options.unit = msi::ReflectanceUnit::Percent;
  EXPECT_EQ(readSampleTable(path, options).reflectance, Eigen::RowVector2d(0.005, 0.015));
  write("t.csv", "sample,R400\na,50\nb,0.5\n");
  options.unit = msi::ReflectanceUnit::Factor;
  EXPECT_EQ(readSampleTable(path, options).reflectance, Eigen::RowVector2d(50, 0.5));
}

TEST_F(SampleTables, TwoMatricesWithoutHeader)
{
  // Two wavelengths and three samples, lying both ways.
  SampleTableOptions options;
  options.wavelengths = msi::WavelengthGrid({ 500, 600 });
  options.responseFile = write("c.txt", "1 2 3 4\n5 6 7 8\n9 10 11 12\n");
  const SampleTable t = readSampleTable(write("r.txt", "0.1 0.2 0.3\n0.4 0.5 0.6\n"), options);
  EXPECT_EQ(t.reflectance, (Eigen::MatrixXd(2, 3) << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6).finished());
  EXPECT_EQ(t.responses.rows(), 4);
  EXPECT_EQ(t.responses.col(1), Eigen::Vector4d(5, 6, 7, 8));
  EXPECT_EQ(t.channelNames.front(), "C1");
  const SampleTable turned =
    readSampleTable(write("r.txt", "0.1,0.4\n0.2,0.5\n0.3,0.6\n"), options);
  EXPECT_EQ(turned.reflectance, t.reflectance);
  EXPECT_EQ(
    turned.notes[0], "the reflectance matrix has rows as samples and 2 wavelengths (500..600 nm)");
}

TEST_F(SampleTables, CsvRoundTripIsExact)
{
  SampleTable t;
  t.metadata = { { "sample", { "a,1", "b \"q\"", "#c" } }, { "order", { "1", "", "3" } } };
  t.wavelengths = msi::WavelengthGrid({ 400.25, 500 });
  t.reflectance = Eigen::MatrixXd::Random(2, 3).cwiseAbs() / 3;
  t.channelNames = { "C1", "C2" };
  t.responses = Eigen::MatrixXd::Random(2, 3) * 1e-17;
  writeSampleTableCsv(path("out.csv"), t);
  const SampleTable back = readSampleTable(path("out.csv"));
  EXPECT_EQ(back.reflectance, t.reflectance);
  EXPECT_EQ(back.responses, t.responses);
  EXPECT_EQ(*back.wavelengths, *t.wavelengths);
  EXPECT_EQ(back.channelNames, t.channelNames);
  EXPECT_EQ(back.metadata[0].text, t.metadata[0].text);
  EXPECT_EQ(back.metadata[1].text, t.metadata[1].text);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(Folder), {}), 1);
}

TEST_F(SampleTables, WritersRefuseTablesThatDisagree)
{
  SampleTable t;
  t.metadata = { { "sample", { "a" } } };
  t.wavelengths = msi::WavelengthGrid({ 400 });
  t.reflectance = Eigen::MatrixXd::Zero(1, 2);
  EXPECT_THROW(writeSampleTableCsv(path("out.csv"), t), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path("out.csv")));
  t.metadata[0].text.push_back("b");
  EXPECT_EQ(errorOf([&] { writeSampleTableCsv(path("no/such/folder.csv"), t); }),
    "no/such/folder.csv: cannot be written (No such file or directory); expected a writable folder "
    "with room in it; check the folder, its access rights and the free space");
}

TEST_F(SampleTables, ReadsThePublishedTables)
{
  MSI_MEASURED_DATA(cotton, "hkpolyu/cotton.csv");
  const SampleTable t = readSampleTable(cotton);
  EXPECT_EQ(t.sampleCount(), 204);
  EXPECT_EQ(*t.wavelengths, msi::WavelengthGrid::uniform(400, 700, 10));
  EXPECT_EQ(*t.channelWavelengths, msi::WavelengthGrid::uniform(400, 700, 20));
  EXPECT_EQ(t.reflectance(0, 0), 0.0606);
  EXPECT_EQ(t.responses(15, 0), 0.48884);
  EXPECT_TRUE(t.notes.empty());
  EXPECT_EQ(readSampleTable(*msi::testing::measuredData("reflectances/colorchecker-sg.csv"))
              .reflectance.cols(),
    140);
  EXPECT_EQ(readSampleTable(*msi::testing::measuredData("filterwheel-cc24/patches.csv"))
              .findMetadata("label")
              ->numbers()[23],
    24);
}

TEST_F(SampleTables, CellsThatLookLikeFormulasAreMarkedAsTextAndComeBack)
{
  msi::SampleTable table;
  const std::vector<std::string> names = { "=HYPERLINK(\"x\")", "+a", "-b", "@c", "'=d", "''=e",
    "'plain", "-0.5", "plain" };
  table.metadata.push_back({ "sample", names });
  table.wavelengths = msi::WavelengthGrid({ 400 });
  table.reflectance = Eigen::MatrixXd::Constant(1, static_cast<Eigen::Index>(names.size()), 0.5);
  msi::writeSampleTableCsv(path("formulas.csv"), table);
  const std::string text = read("formulas.csv");
  for (const char* mark : { "\n=", "\n+", "\n-b", "\n@", "\n\"=" })
  {
    EXPECT_EQ(text.find(mark), std::string::npos) << mark;
  }
  EXPECT_EQ(readSampleTable(path("formulas.csv")).metadata[0].text, names);
}

} // namespace

#include "Formats/Capture.h"

#include "Support/formats/TestFiles.h"

#include <algorithm>

namespace
{

class Captures : public msi::testing::TemporaryFolder
{
protected:
  Captures()
  {
    write("c/capture.json",
      R"({"name": "bench", "white_level": 60000, "dark": 0.01, "noise": {"read": 0.001, "shot": null}})");
    write("c/camera.csv", "wavelength,blue,red\n420,0.1,0.2\n400,0.3,0.4\n410,0.5,0.6\n");
    write("c/samples.csv", "sample,R400,R410,R420\na,0.1,0.2,0.3\nb,0.4,0.5,0.6\n");
    write("c/responses.csv",
      "sample,repeat,C1,C2,order\na,1,0.1,0.2,7\nb,1,0.3,0.4,8\na,2,0.5,0.6,9\n");
  }
  msi::Capture capture() const { return msi::readCapture(path("c")); }
  std::string captureError() const
  {
    return errorOf([&] { capture(); });
  }
  std::string descriptionError(const std::string& json) const
  {
    return errorOf([&] { msi::readCaptureDescription(write("capture.json", json)); });
  }
  std::string curvesError(const std::string& text) const
  {
    return errorOf([&] { msi::readCameraCurves(write("camera.csv", text)); });
  }
};

TEST_F(Captures, ReadsTheWholeFolder)
{
  write("c/images/simulated10.tif", "");
  write("c/images/simulated9.tif", "");
  const msi::Capture c = capture();
  EXPECT_EQ(c.description.name, "bench");
  EXPECT_EQ(c.description.whiteLevel, 60000);
  EXPECT_EQ(c.description.dark, (std::vector<double>{ 0.01, 0.01 }));
  EXPECT_EQ(c.description.noise.read, 0.001);
  EXPECT_FALSE(c.description.noise.shot.has_value());
  EXPECT_EQ(c.camera.names, (std::vector<std::string>{ "blue", "red" }));
  EXPECT_EQ(c.camera.wavelengths, msi::WavelengthGrid({ 400, 410, 420 }));
  EXPECT_EQ(c.camera.values, (Eigen::MatrixXd(3, 2) << 0.3, 0.4, 0.5, 0.6, 0.1, 0.2).finished());
  EXPECT_EQ(c.samples.sampleCount(), 2);
  EXPECT_EQ(c.readings.sample, (std::vector<std::string>{ "a", "b", "a" }));
  EXPECT_EQ(c.readings.repeat, (std::vector<int>{ 1, 1, 2 }));
  EXPECT_EQ(c.readings.responses.col(2), Eigen::Vector2d(0.5, 0.6));
  EXPECT_EQ(c.readings.metadata[0].name, "order");
  ASSERT_EQ(c.imageFiles.size(), 2u);
  EXPECT_EQ(c.imageFiles[0], path("c/images/simulated9.tif"));
}

TEST_F(Captures, NullMeansUnknown)
{
  const auto d = msi::readCaptureDescription(
    write("capture.json", R"({"white_level": null, "dark": null, "noise": null, "lens": 1})"));
  EXPECT_FALSE(d.whiteLevel.has_value());
  EXPECT_TRUE(d.dark.empty());
  EXPECT_FALSE(d.noise.read.has_value());
  EXPECT_EQ(d.notes, (std::vector<std::string>{ "capture.json: key 'lens' was left unread" }));
}

TEST_F(Captures, RepeatsAreCountedWhereNotNamed)
{
  const auto readings = msi::readRepeatedResponses(write("r.csv", "sample,C1\na,1\nb,2\na,3\n"));
  EXPECT_EQ(readings.repeat, (std::vector<int>{ 1, 1, 2 }));
}

TEST_F(Captures, DescriptionErrors)
{
  EXPECT_EQ(descriptionError("{\n  \"name\": x }"),
    "capture.json:2:11: this is no JSON; expected a JSON object; correct this line");
  EXPECT_EQ(descriptionError("{\"name\": \"a\",\n \"dark\": [1, "),
    "capture.json:2:14: the JSON text ends too early; expected a JSON object; the file seems to be "
    "cut off");
  EXPECT_EQ(descriptionError("[1]"),
    "capture.json: holds array; expected an object with name, white_level, dark and noise; see "
    "Formats.md");
  EXPECT_EQ(descriptionError("{\n\"dark\": \"low\"}"),
    "capture.json:2:1: 'dark' has a value that cannot be used; expected a number or a list with "
    "one "
    "number per channel; correct the value");
  EXPECT_EQ(descriptionError("{\"noise\": {\"read\": -1}}"),
    "capture.json:1:12: 'read' has a value that cannot be used; expected a number from 0 up, or "
    "null; "
    "correct the value");
  EXPECT_EQ(descriptionError("{\"white_level\": 4095, \"noise\": {\"read\": 12}}"),
    "capture.json:1:33: 'read' has a value that cannot be used; expected a standard deviation "
    "relative to white, up to 0.5 (counts over the white level), or null; correct the value");
  EXPECT_EQ(descriptionError("{\"white_level\": 0}"),
    "capture.json:1:2: 'white_level' has a value that cannot be used; expected a number above 0; "
    "correct the value");
}

TEST_F(Captures, CurveErrors)
{
  EXPECT_EQ(curvesError("filter,a\n400,1\n"),
    "camera.csv:1:1: the first column is 'filter'; expected a column named wavelength, one row a "
    "wavelength; rename the column");
  EXPECT_EQ(curvesError("wavelength\n400\n"),
    "camera.csv:1:1: there is a wavelength column but no curve; expected at least two columns; "
    "check "
    "how the file was written");
  EXPECT_EQ(curvesError("wavelength,a\n"),
    "camera.csv:1:1: there is a header but no row; expected one row a wavelength below the header; "
    "check how the file was written");
  EXPECT_EQ(curvesError("wavelength,a\n400,1\n410,1\n430,1\n"),
    "camera.csv: the wavelengths step by 10 nm at first and by 20 nm before 430 nm; expected a "
    "uniform grid; interpolate the curves");
  EXPECT_EQ(curvesError("wavelength,a,a\n400,1,2\n"),
    "camera.csv:1:14: two columns are named 'a'; expected different names in the header; name the "
    "column or remove it");
  EXPECT_EQ(curvesError("wavelength,a\n50,1\n60,1\n"),
    "camera.csv:2:1: wavelength 1 is 50 nm; expected a value from 100 to 20000 nm; state the "
    "wavelengths in nanometres");
}

TEST_F(Captures, MicrometresBecomeNanometres)
{
  const auto curves = msi::readCurves(write("c.csv", "0.4 1 2\n0.5 3 4\n"));
  EXPECT_EQ(curves.wavelengths, msi::WavelengthGrid({ 400, 500 }));
  EXPECT_EQ(curves.notes[0], "wavelengths were in micrometres: multiplied by 1000");
  EXPECT_EQ(curves.names, (std::vector<std::string>{ "curve1", "curve2" }));
}

TEST_F(Captures, PartsThatDisagree)
{
  EXPECT_EQ(errorOf([&] { msi::readCapture(path("none")); }),
    "none: is no folder; expected a folder with capture.json, camera.csv, samples.csv and "
    "responses.csv; name the folder of the capture");
  write("c/capture.json", R"({"dark": [1, 2, 3]})");
  EXPECT_EQ(captureError(),
    "c/capture.json: 'dark' has 3 values; expected one, or 2 as camera.csv has channels; correct "
    "the "
    "list");
  write("c/capture.json", "{}");
  write("c/responses.csv", "sample,C1,C2\na,1,2\nz,1,2\n");
  EXPECT_EQ(captureError(),
    "c/responses.csv: sample 'z' is not in samples.csv; expected a reflectance for every reading; "
    "add "
    "the sample to samples.csv or remove its readings");
  write("c/responses.csv", "sample,C1\na,1\n");
  EXPECT_EQ(captureError(),
    "c/responses.csv: has 1 channels; expected 2, as camera.csv has; give both the same channels");
  write("c/responses.csv", "sample,repeat,C1,C2\na,1,1,2\na,1,1,2\n");
  EXPECT_EQ(captureError(),
    "c/responses.csv:3:1: sample 'a' has repeat 1 a second time; expected another number for each "
    "reading of a sample; correct the number or remove the row");
  write("c/responses.csv", "sample,repeat,C1,C2\na,first,1,2\n");
  EXPECT_EQ(captureError(),
    "c/responses.csv:2:1: repeat is 'first'; expected a whole number from 0 up; number the "
    "readings "
    "of each sample");
  write("c/responses.csv", "name,C1,C2\na,1,2\n");
  EXPECT_EQ(captureError(),
    "c/responses.csv:1:1: there is no column 'sample'; expected the columns sample, repeat, C1, "
    "C2, "
    "...; rename the columns");
  write("c/samples.csv", "sample,C1\na,1\n");
  write("c/responses.csv", "sample,C1,C2\na,1,2\n");
  EXPECT_EQ(captureError(),
    "c/samples.csv: has no reflectance; expected columns R400, R410, ...; add the measured "
    "reflectance of the samples");
}

TEST_F(Captures, CurvesRoundTripIsExact)
{
  const msi::Curves curves{ msi::WavelengthGrid({ 400, 401.5 }), { "a,b", "c" },
    Eigen::MatrixXd::Random(2, 2), {} };
  msi::writeCurves(path("c.csv"), curves);
  const auto back = msi::readCurves(path("c.csv"));
  EXPECT_EQ(back.values, curves.values);
  EXPECT_EQ(back.names, curves.names);
  EXPECT_EQ(back.wavelengths, curves.wavelengths);
}

TEST_F(Captures, ReadsTheStandardTables)
{
  const std::string tables = std::string(MULTISPECTRAL_SOURCE_DIR) + "/Data/Tables/";
  const auto observer = msi::readCurves(tables + "observer_CIE1931_2deg.csv");
  EXPECT_EQ(observer.wavelengths.front(), 360);
  EXPECT_EQ(observer.names, (std::vector<std::string>{ "xbar", "ybar", "zbar" }));
  EXPECT_EQ(msi::readCurves(tables + "illuminant_D65.csv").values.cols(), 1);
}

TEST_F(Captures, ChannelsNamedAlikeFollowTheResponses)
{
  write("c/camera.csv", "wavelength,C2,C1\n400,0.3,0.4\n410,0.5,0.6\n420,0.1,0.2\n");
  write("c/capture.json", R"({"dark": [0.02, 0.01]})");
  const msi::Capture c = capture();
  EXPECT_EQ(c.camera.names, (std::vector<std::string>{ "C1", "C2" }));
  EXPECT_EQ(c.camera.values, (Eigen::MatrixXd(3, 2) << 0.4, 0.3, 0.6, 0.5, 0.2, 0.1).finished());
  EXPECT_EQ(c.description.dark, (std::vector<double>{ 0.01, 0.02 }));
  EXPECT_EQ(c.description.notes,
    (std::vector<std::string>{
      "camera.csv and responses.csv order the channels differently: matched by name" }));
}

TEST_F(Captures, CountsAreDividedByTheWhiteLevel)
{
  write("c/capture.json", R"({"white_level": 1000, "dark": 20})");
  write("c/responses.csv", "sample,C1,C2\na,100,200\nb,300,400\n");
  const msi::Capture c = capture();
  EXPECT_EQ(c.readings.responses, (Eigen::Matrix2d() << 0.1, 0.3, 0.2, 0.4).finished());
  EXPECT_EQ(c.description.dark, (std::vector<double>{ 0.02, 0.02 }));
  EXPECT_EQ(c.camera.values(0, 0), 0.3); // relative already
  EXPECT_EQ(c.description.notes,
    (std::vector<std::string>{
      "the responses in responses.csv were in counts: divided by the white level 1000",
      "the dark values in capture.json were in counts: divided by the white level 1000" }));
}

TEST_F(Captures, DarkValuesAreInTheUnitOfTheCurves)
{
  write("c/capture.json", R"({"white_level": 1000, "dark": 1.5})");
  write("c/camera.csv", "wavelength,C1,C2\n400,300,400\n410,500,600\n420,100,200\n");
  const msi::Capture c = capture();
  EXPECT_EQ(c.camera.values(0, 0), 0.3);
  EXPECT_EQ(c.description.dark, (std::vector<double>{ 0.0015, 0.0015 }));
}

TEST_F(Captures, AResponseBeyondWhiteIsNoCount)
{
  write("c/responses.csv", "sample,C1,C2\na,1.5,2.9\nb,3,2.7\n");
  write("c/capture.json", R"({"white_level": 65535})");
  EXPECT_EQ(captureError(),
    "c/responses.csv: the responses reach 3; expected values up to 2, relative to white, or "
    "counts for the 'white_level' in capture.json, 65535; correct 'white_level': the counts of the "
    "perfect white, or 1 for values relative to it");
  write("c/capture.json", R"({"white_level": 1})");
  const msi::Capture c = capture();
  EXPECT_EQ(c.readings.responses, (Eigen::Matrix2d() << 1.5, 3, 2.9, 2.7).finished());
  EXPECT_TRUE(c.description.notes.empty());
  write("c/responses.csv", "sample,C1,C2\na,1500,2900\nb,3000,2700\n");
  EXPECT_NE(captureError().find("the responses reach 3000, which looks like counts; expected"),
    std::string::npos);
}

TEST_F(Captures, CountsWithoutAWhiteLevelAreRefused)
{
  write("c/capture.json", "{}");
  write("c/responses.csv", "sample,C1,C2\na,100,200\nb,300,400\n");
  EXPECT_EQ(captureError(),
    "c/responses.csv: the responses reach 400, which looks like counts; expected values relative "
    "to "
    "white (1 = perfect white), or the counts of white as 'white_level' in capture.json; divide "
    "them "
    "by the counts of the perfect white");
}
}

TEST_F(Captures, SeveralOfOneCameraAreScenesOfOne)
{
  write("d/capture.json", R"({"name": "dark", "white_level": 60000, "dark": 0.01})");
  write("d/camera.csv", "wavelength,blue,red\n420,0.1,0.2\n400,0.3,0.4\n410,0.5,0.6\n");
  write("d/samples.csv", "sample,medium,R400,R410,R420\na,cap,0,0,0\nlid,cap,0,0,0\n");
  write("d/responses.csv", "sample,repeat,C1,C2,light\na,1,0.01,0.02,off\nlid,1,0.03,0.04,off\n");
  const msi::Capture c = msi::readCaptures({ path("c"), path("d") });
  const auto cells = [](const std::vector<msi::MetadataColumn>& columns, const std::string& name)
  {
    const auto found = std::find_if(
      columns.begin(), columns.end(), [&](const auto& column) { return column.name == name; });
    return found != columns.end() ? found->text : std::vector<std::string>{};
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(c.samples.sampleNames(), (Texts{ "a", "b", "a (dark)", "lid" }));
  EXPECT_EQ(cells(c.samples.metadata, "scene"), (Texts{ "bench", "bench", "dark", "dark" }));
  EXPECT_EQ(cells(c.samples.metadata, "medium"), (Texts{ "", "", "cap", "cap" }));
  EXPECT_EQ(c.samples.reflectance.row(2), Eigen::RowVector4d(0.3, 0.6, 0.0, 0.0));
  EXPECT_EQ(c.readings.sample, (Texts{ "a", "b", "a", "a (dark)", "lid" }));
  EXPECT_EQ(c.readings.repeat, (std::vector<int>{ 1, 1, 2, 1, 1 }));
  EXPECT_EQ(
    c.readings.responses.row(1), (Eigen::RowVectorXd(5) << 0.2, 0.4, 0.6, 0.02, 0.04).finished());
  EXPECT_EQ(cells(c.readings.metadata, "order"), (Texts{ "7", "8", "9", "", "" }));
  EXPECT_EQ(cells(c.readings.metadata, "light"), (Texts{ "", "", "", "off", "off" }));
  EXPECT_EQ(c.description.noise.read, 0.001);

  // A capture without a name has that of its folder.
  write("d/capture.json", R"({"white_level": 60000, "dark": 0.01})");
  EXPECT_EQ(cells(msi::readCaptures({ path("c"), path("d/") }).samples.metadata, "scene"),
    (Texts{ "bench", "bench", "d", "d" }));

  EXPECT_EQ(errorOf(
              [&] {
                msi::readCaptures({ path("c"), path("d"), path("d/../d") });
              }),
    "d/../d: is the same capture as d; expected another capture of the same camera; name each "
    "capture once");

  write("d/camera.csv", "wavelength,blue,red\n420,0.1,0.2\n400,0.3,0.4\n410,0.5,0.7\n");
  EXPECT_NE(errorOf(
              [&] {
                msi::readCaptures({ path("c"), path("d") });
              })
              .find("d/camera.csv: is another simulated camera"),
    std::string::npos);
}

#include "CameraTable.h"

#include "Support/vtk/ErrorText.h"
#include "Support/vtk/Tables.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

CameraModel twoChannels(std::vector<std::string> names = {})
{
  return { WavelengthGrid({ 400.0, 410.0, 420.0 }),
    (Eigen::MatrixXd(2, 3) << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6).finished(), Eigen::Vector2d(0.01, 0.02),
    std::move(names) };
}

std::string errorOf(vtkTable* table)
{
  return argumentError([&] { readCamera(table, "the camera"); });
}

vtkSmartPointer<vtkTable> curves()
{
  return newTable(
    { { "wavelength", { 400.0, 410.0 } }, { "C1", { 0.1, 0.2 } }, { "C2", { 0.3, 0.4 } } });
}

void addField(vtkTable* table, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  table->GetFieldData()->AddArray(array);
}

TEST(CameraTable, KeepsEverything)
{
  const CameraTable written{ twoChannels({ "blue", "red" }),
    CameraNoise{ 0.001, 0.002, 0.0, 0.003, 0.25 }, "[{\"effect\": \"lag\"}]", true, 4095.0 };
  vtkNew<vtkTable> table;
  write(written, table);
  EXPECT_EQ(columnNames(table), (std::vector<std::string>{ "wavelength", "blue", "red" }));
  const CameraTable read = readCamera(table, "the camera");
  EXPECT_EQ(read.camera.wavelengths(), written.camera.wavelengths());
  EXPECT_EQ(read.camera.responsivity(), written.camera.responsivity());
  EXPECT_EQ(read.camera.dark(), written.camera.dark());
  EXPECT_EQ(read.camera.channels(), written.camera.channels());
  ASSERT_TRUE(read.noise);
  EXPECT_EQ(read.noise->shot, 0.002);
  EXPECT_EQ(read.noise->fixedPatternOffset, 0.003);
  EXPECT_EQ(read.noise->quantisationStep, 0.25);
  EXPECT_EQ(read.effects, written.effects);
  EXPECT_TRUE(read.whiteAfterEffects);
  EXPECT_EQ(read.whiteLevel, 4095.0);
}

TEST(CameraTable, NoiseOfTwoNumbersIsReadAndShot)
{
  vtkNew<vtkTable> table;
  write({ twoChannels(), CameraNoise{ 0.001, 0.002 } }, table);
  EXPECT_EQ(table->GetFieldData()->GetArray("Noise")->GetNumberOfTuples(), 2);
  EXPECT_EQ(readCamera(table, "the camera").noise->read, 0.001);
}

TEST(CameraTable, CurvesAloneAreACamera)
{
  const auto camera = readCamera(curves(), "the camera");
  EXPECT_EQ(camera.camera.dark(), Eigen::Vector2d::Zero());
  EXPECT_FALSE(camera.noise);
  EXPECT_TRUE(camera.effects.empty());
  EXPECT_FALSE(camera.whiteAfterEffects);
  EXPECT_EQ(camera.whiteLevel, 1.0);
}

TEST(CameraTable, SortsRowsByWavelength)
{
  const auto camera = readCamera(
    newTable({ { "C1", { 0.2, 0.3, 0.1 } }, { "wavelength", { 410.0, 420.0, 400.0 } } }), "it");
  EXPECT_EQ(camera.camera.responsivity(), Eigen::RowVector3d(0.1, 0.2, 0.3));
}

TEST(CameraTable, Errors)
{
  EXPECT_EQ(errorOf(nullptr),
    "the camera is empty; expected a table with wavelength and one curve a channel");
  EXPECT_EQ(errorOf(newTable({ { "C1", { 1.0 } } })),
    "the camera has no column of numbers 'wavelength'; expected wavelength and one curve a "
    "channel");
  EXPECT_EQ(errorOf(newTable({ { "wavelength", { 400.0 } } })),
    "the camera has no curve; expected one column a channel beside wavelength");
  EXPECT_EQ(errorOf(newTable({ { "wavelength", { 400.0, 410.0, 430.0 } }, { "C1", { 1, 1, 1 } } })),
    "the camera: the wavelengths are no uniform grid; interpolate the curves");
  const auto text = curves();
  addTextColumn(text, "note", { "a", "b" });
  EXPECT_EQ(errorOf(text),
    "the camera: the column 'note' is not a column of numbers; expected wavelength and one curve a "
    "channel");
  const auto dark = curves();
  addField(dark, "Dark", { 1.0, 2.0, 3.0 });
  EXPECT_EQ(errorOf(dark),
    "the camera: the field data 'Dark' have 3 values; expected one, or 2 as there are channels");
  const auto noise = curves();
  addField(noise, "Noise", { 1.0, -2.0 });
  EXPECT_EQ(errorOf(noise),
    "the camera: the field data 'Noise' are 2 numbers; expected read and shot, or those with fixed "
    "pattern gain, fixed pattern offset and quantisation step, each from 0 up");
  const auto level = curves();
  addField(level, "WhiteLevel", { 0.0 });
  EXPECT_EQ(errorOf(level), "the camera: the field data 'WhiteLevel' are not one number above 0");
  const auto words = curves();
  vtkNew<vtkStringArray> array;
  array->SetName("Dark");
  words->GetFieldData()->AddArray(array);
  EXPECT_EQ(errorOf(words), "the camera: the field data 'Dark' are no numbers");
}

TEST(CameraTable, ChannelsAreNamedByWavelengthOrNumbered)
{
  const auto names = [](std::vector<std::string> channels)
  { return channelsOf(twoChannels(std::move(channels))).names; };
  EXPECT_EQ(names({ "C400", "C420.5" }), (std::vector<std::string>{ "400", "420.5" }));
  EXPECT_EQ(names({ "400nm", "420" }), (std::vector<std::string>{ "400", "420" }));
  EXPECT_TRUE(channelsOf(twoChannels({ "400", "420" })).wavelengths);
  EXPECT_EQ(names({ "C1", "C2" }), (std::vector<std::string>{ "C1", "C2" }));
  EXPECT_EQ(names({ "blue", "red" }), (std::vector<std::string>{ "C1", "C2" }));
  EXPECT_EQ(names({ "C420", "C400" }), (std::vector<std::string>{ "C1", "C2" }));
}
}

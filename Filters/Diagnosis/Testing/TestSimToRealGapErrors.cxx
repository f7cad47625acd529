#include "vtkSimToRealGap.h"

#include "GapTestTables.h"
#include "Support/vtk/Runs.h"

#include "vtkFieldData.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using msi::testing::GapTestTables;

class SimToRealGapErrors : public ::testing::Test
{
protected:
  std::string error()
  {
    vtkNew<vtkSimToRealGap> gap;
    for (const auto& effect : Without)
    {
      gap->AddWithout(effect.c_str());
    }
    gap->SetInputDataObject(0, Tables.camera);
    gap->SetInputDataObject(1, Tables.samples);
    gap->SetInputDataObject(2, Tables.responses);
    return msi::testing::errorOf(gap);
  }

  GapTestTables Tables{ 0.9 };
  std::vector<std::string> Without;
};

TEST_F(SimToRealGapErrors, OtherChannels)
{
  Tables.responses->RemoveColumnByName("C2");
  EXPECT_EQ(error(),
    "the camera table has 4 channels, but the responses table has 3; both must be of the same "
    "camera with the same channels");
}

TEST_F(SimToRealGapErrors, NoReflectance)
{
  while (Tables.samples->GetNumberOfColumns() > 5)
  {
    Tables.samples->RemoveColumn(5);
  }
  EXPECT_EQ(error(),
    "the samples table has no columns of measured reflectance (R400, R410, ..); it has 5 other "
    "columns");
}

TEST_F(SimToRealGapErrors, ReadingOfAnUnknownSample)
{
  Tables.responses->SetValueByName(2, "sample", vtkVariant("stranger"));
  EXPECT_EQ(error(),
    "the responses table has sample 'stranger', but the samples table has not; expected a "
    "reflectance for every reading");
}

TEST_F(SimToRealGapErrors, ReadingsWithoutSample)
{
  Tables.responses->RemoveColumnByName("sample");
  EXPECT_EQ(error(),
    "the responses table has no column 'sample'; expected the name of the sample of each reading");
}

TEST_F(SimToRealGapErrors, SampleTwice)
{
  Tables.samples->SetValueByName(2, "sample", vtkVariant("s1"));
  EXPECT_EQ(error(), "the samples table has sample 's1' twice; expected each sample once");
}

TEST_F(SimToRealGapErrors, PositionAsText)
{
  Tables.samples->RemoveColumnByName("x");
  msi::testing::addTextColumn(
    Tables.samples, "x", std::vector<std::string>(GapTestTables::Samples, "left"));
  EXPECT_EQ(error(), "the samples table: column 'x' is not a column of numbers");
}

TEST_F(SimToRealGapErrors, CameraWithEffects)
{
  auto camera = msi::readCamera(Tables.camera, "camera");
  camera.effects = R"([{"effect": "exposure_gain", "parameters": {"gain": 0.9}}])";
  msi::write(camera, Tables.camera);
  EXPECT_EQ(error(),
    "the camera table has effects in its field data; the diagnosis looks for effects of a camera "
    "without any: give the camera as designed");
}

TEST_F(SimToRealGapErrors, UnknownEffect)
{
  Without = { "magic" };
  EXPECT_EQ(error(), "there is no effect 'magic' to leave out");
}

TEST_F(SimToRealGapErrors, NothingMeasured)
{
  for (const char* name : { "C1", "C2", "C3", "C4" })
  {
    for (vtkIdType row = 1; row < GapTestTables::Samples; ++row)
    {
      Tables.responses->SetValueByName(
        row, name, vtkVariant(std::numeric_limits<double>::quiet_NaN()));
    }
  }
  EXPECT_EQ(
    error(), "a diagnosis needs 5 samples or more with reading and reflectance; 1 of 40 have both");
}

// Data that no camera and no spectrophotometer gives must not be explained.
TEST_F(SimToRealGapErrors, OneMarkForAMissingValueAmongTheReadings)
{
  Tables.responses->SetValueByName(7, "C3", vtkVariant(-9999.0));
  EXPECT_EQ(error(),
    "the responses table sample 8, response channel 3 is -9999; expected -10 to 1000, as the other "
    "responses are; "
    "remove the sample if this marks a missing value");
}

TEST_F(SimToRealGapErrors, OneMarkForAMissingValueAmongTheReflectances)
{
  Tables.samples->SetValueByName(2, "R450", vtkVariant(-1e9));
  EXPECT_EQ(error(),
    "the samples table sample 3, reflectance band 6 is -1e+09; expected -1 to 100, where 1 is the "
    "perfect white; "
    "remove the sample if this marks a missing value");
}

TEST_F(SimToRealGapErrors, ADeadChannel)
{
  for (vtkIdType row = 0; row < GapTestTables::Samples; ++row)
  {
    Tables.responses->SetValueByName(row, "C2", vtkVariant(0.0));
  }
  EXPECT_EQ(error(),
    "the responses table: channel C2 is 0 in every reading; expected the answers of a camera: "
    "leave a dead channel out "
    "of both cameras");
}

TEST_F(SimToRealGapErrors, ACameraWithoutCurves)
{
  auto camera = msi::readCamera(Tables.camera, "camera");
  Eigen::MatrixXd curves = camera.camera.responsivity();
  curves.row(1).setZero();
  camera.camera = msi::CameraModel(
    camera.camera.wavelengths(), curves, camera.camera.dark(), camera.camera.channels());
  msi::write(camera, Tables.camera);
  EXPECT_EQ(error(),
    "channel C2 of the camera table answers to no light: its curve is 0; expected responsivities "
    "above 0");
}

TEST_F(SimToRealGapErrors, ACameraBesideTheMeasuredWavelengths)
{
  auto camera = msi::readCamera(Tables.camera, "camera");
  camera.camera = msi::CameraModel(msi::WavelengthGrid::uniform(900.0, 1200.0, 10.0),
    camera.camera.responsivity(), camera.camera.dark(), camera.camera.channels());
  msi::write(camera, Tables.camera);
  EXPECT_EQ(error(),
    "channel C1 of the camera table gets 100 % of its response from wavelengths where no "
    "reflectance was measured "
    "(measured: 400 to 700 nm); expected curves over the measured wavelengths: check the "
    "wavelengths of both");
}

TEST_F(SimToRealGapErrors, ACameraOfOneWavelength)
{
  auto camera = msi::readCamera(Tables.camera, "camera");
  camera.camera = msi::CameraModel(msi::WavelengthGrid({ 550.0 }),
    camera.camera.responsivity().rowwise().sum(), camera.camera.dark(), camera.camera.channels());
  msi::write(camera, Tables.camera);
  EXPECT_EQ(error(),
    "the camera table has 1 wavelength; expected the responsivity of each channel over the "
    "spectrum");
}
}

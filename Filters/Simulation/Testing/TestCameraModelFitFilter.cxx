#include "vtkCameraModelFit.h"
#include "vtkCameraSimulator.h"

#include "SimulationTestData.h"

#include "Support/vtk/Runs.h"

#include "vtkFieldData.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

class CameraModelFits : public ::testing::Test
{
protected:
  CameraModelFits()
  {
    auto chart = rasterTable();
    addSpectra(chart, 'C', WavelengthGrid::uniform(430.0, 670.0, 40.0), Response);
    Fit->SetInputData(0, chart);
    Fit->SetDraws(20);
  }
  const CameraModel Camera = test::sevenChannels();
  const Eigen::MatrixXd Response =
    (Camera.responsivity() * test::rasterSamples().reflectance).colwise() + Camera.dark();
  vtkNew<vtkCameraModelFit> Fit;
};

TEST_F(CameraModelFits, TheFittedCameraAnswersAsTheChartDid)
{
  ASSERT_EQ(errorOf(Fit), "");
  vtkNew<vtkCameraSimulator> simulator;
  simulator->SetInputData(0, rasterTable());
  simulator->SetInputConnection(1, Fit->GetOutputPort(0));
  ASSERT_EQ(errorOf(simulator), "");
  const Eigen::MatrixXd error = responsesOf(simulator->GetTableOutput()) - Response;
  EXPECT_LT(std::sqrt(error.array().square().mean()), 2e-3);
  EXPECT_NE(simulator->GetTableOutput()->GetColumnByName("C430"), nullptr);
}

TEST_F(CameraModelFits, TablesSayWhatTheFitKnows)
{
  ASSERT_EQ(errorOf(Fit), "");
  auto* camera = vtkTable::SafeDownCast(Fit->GetOutputDataObject(0));
  EXPECT_EQ(columnNames(camera),
    (std::vector<std::string>{
      "wavelength", "C430", "C470", "C510", "C550", "C590", "C630", "C670" }));
  auto* errors = vtkTable::SafeDownCast(Fit->GetOutputDataObject(1));
  ASSERT_EQ(errors->GetNumberOfRows(), 31);
  EXPECT_GE(cell(errors, 0, "resolution"), 10.0);
  EXPECT_GT(cell(errors, 13, "C550"), 0.0);
  EXPECT_EQ(errors->GetFieldData()->GetArray("Dark")->GetNumberOfTuples(), 7);
  auto* summary = vtkTable::SafeDownCast(Fit->GetOutputDataObject(2));
  EXPECT_EQ(cell(summary, 0, "samples"), 48.0);
  EXPECT_EQ(cell(summary, 0, "channels"), 7.0);
  EXPECT_EQ(cell(summary, 0, "directions"), 31.0);
  EXPECT_GE(cell(summary, 0, "held_out_rms"), cell(summary, 0, "residual_rms"));
  EXPECT_EQ(textCell(summary, 0, "status").rfind("the chart determines ", 0), 0u);
  auto* channels = vtkTable::SafeDownCast(Fit->GetOutputDataObject(3));
  ASSERT_EQ(channels->GetNumberOfRows(), 7);
  EXPECT_EQ(textCell(channels, 3, "channel"), "C550");
  EXPECT_NEAR(cell(channels, 3, "centroid"), Camera.centroids()[3], 10.0);
  EXPECT_NEAR(cell(channels, 3, "dark"), Camera.dark()[3], 5e-3);
}

TEST_F(CameraModelFits, KeepsTheDarkResponseOfTheNominalCamera)
{
  Fit->SetKeepDark(true);
  EXPECT_EQ(errorOf(Fit),
    "KeepDark is on, but there is no nominal camera on the second input; connect one or turn "
    "KeepDark off");
  Fit->SetInputData(1, cameraTable());
  ASSERT_EQ(errorOf(Fit), "");
  auto* channels = vtkTable::SafeDownCast(Fit->GetOutputDataObject(3));
  for (vtkIdType k = 0; k < 7; ++k)
  {
    EXPECT_EQ(cell(channels, k, "dark"), Camera.dark()[k]);
  }
  // With the camera that it is, the chart asks for no departure.
  const auto fitted = readCamera(vtkTable::SafeDownCast(Fit->GetOutputDataObject(0)), "it").camera;
  EXPECT_LT((fitted.responsivity() - Camera.responsivity()).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_F(CameraModelFits, WithoutDrawsThereAreNoStandardErrors)
{
  Fit->SetDraws(0);
  ASSERT_EQ(errorOf(Fit), "");
  EXPECT_EQ(columnNames(vtkTable::SafeDownCast(Fit->GetOutputDataObject(1))),
    (std::vector<std::string>{ "wavelength", "resolution" }));
  EXPECT_EQ(
    vtkTable::SafeDownCast(Fit->GetOutputDataObject(3))->GetColumnByName("dark_error"), nullptr);
}

TEST_F(CameraModelFits, Errors)
{
  Fit->SetPassbandWidth(0.0);
  EXPECT_EQ(errorOf(Fit), "the passband width is 0 nm; expected above 0");
  Fit->SetPassbandWidth(15.0);
  Fit->SetFolds(100);
  EXPECT_EQ(errorOf(Fit), "the cross-validation has 100 folds; expected 2 to 48");
  Fit->SetFolds(5);
  vtkNew<vtkTable> other;
  write(
    CameraTable{ { test::visibleGrid(), Eigen::MatrixXd::Ones(2, 31), Eigen::Vector2d::Zero() } },
    other);
  Fit->SetInputData(1, other);
  EXPECT_NE(errorOf(Fit).find("the nominal camera has 2 channels"), std::string::npos);
  Fit->SetInputData(0, rasterTable());
  EXPECT_EQ(errorOf(Fit).rfind("the chart has no columns of camera responses", 0), 0u);
  EXPECT_NE(printed(Fit).find("Folds: 5"), std::string::npos);
}
}

#include "vtkResponseDifference.h"

#include "SimulationTestData.h"

#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

TEST(ResponseDifferences, OfTables)
{
  vtkNew<vtkResponseDifference> difference;
  difference->SetInputData(0,
    newTable(
      { { "C1", { 0.5, 1.0, 1.5 } }, { "C2", { 1.0, 1.0, 1.0 } }, { "x", { 7.0, 8.0, 9.0 } } }));
  difference->SetInputData(
    1, newTable({ { "C400", { 0.25, 0.5, 0.75 } }, { "C500", { 1.0, 0.5, 0.0 } } }));
  ASSERT_EQ(errorOf(difference), "");
  auto* samples = vtkTable::SafeDownCast(difference->GetOutputDataObject(0));
  EXPECT_EQ(cell(samples, 2, "x"), 9.0);
  EXPECT_EQ(cell(samples, 2, "simulated C1"), 0.75);
  EXPECT_EQ(cell(samples, 2, "difference C1"), 0.75);
  EXPECT_EQ(cell(samples, 1, "difference C2"), 0.5);
  auto* channels = vtkTable::SafeDownCast(difference->GetOutputDataObject(1));
  ASSERT_EQ(channels->GetNumberOfRows(), 2);
  EXPECT_EQ(textCell(channels, 0, "channel"), "C1");
  EXPECT_EQ(cell(channels, 0, "samples"), 3.0);
  EXPECT_DOUBLE_EQ(cell(channels, 0, "gain"), 2.0);
  EXPECT_NEAR(cell(channels, 0, "offset"), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(cell(channels, 0, "mean"), 0.5);
  EXPECT_DOUBLE_EQ(cell(channels, 1, "mean"), 0.5);
  EXPECT_NEAR(cell(channels, 0, "rms_around_line"), 0.0, 1e-15);
}

TEST(ResponseDifferences, OfImagesInPiecesAndThreads)
{
  const WavelengthGrid grid({ 400.0, 500.0 });
  vtkNew<PieceSource> real;
  vtkNew<PieceSource> simulated;
  const Eigen::MatrixXd values = patternValues(2, 60 * 50);
  real->SetImage(newImage(60, 50, ResponsesArray, values, grid));
  simulated->SetImage(newImage(60, 50, ResponsesArray, 0.5 * values, grid));
  vtkNew<vtkResponseDifference> difference;
  difference->SetInputConnection(0, real->GetOutputPort());
  difference->SetInputConnection(1, simulated->GetOutputPort());
  ASSERT_EQ(errorOf(difference), "");
  auto* image = vtkImageData::SafeDownCast(difference->GetOutputDataObject(0));
  EXPECT_LT((valuesOf(image, "Difference") - 0.5 * values).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(axisOf(image, image->GetPointData()->GetScalars()).wavelengths, grid);
  expectSameBytesInPieces(difference, 3);
  expectSameBytesInThreads(difference);
}

TEST(ResponseDifferences, Errors)
{
  vtkNew<vtkResponseDifference> difference;
  difference->SetInputData(0, newTable({ { "C1", { 0.5, 1.0 } } }));
  difference->SetInputData(1, newTable({ { "C1", { 0.5 } } }));
  EXPECT_EQ(errorOf(difference),
    "the real camera has 1 channels and 2 samples, the simulated one 1 and 1; expected the same");
  difference->SetInputData(0, newImage(2, 1, ResponsesArray, patternValues(2, 2)));
  EXPECT_EQ(errorOf(difference),
    "one input is an image and the other is none; expected two sample tables or two images");
  difference->SetInputData(1, newImage(2, 1, ResponsesArray, patternValues(3, 2)));
  EXPECT_EQ(errorOf(difference),
    "the real responses are 2 pixels of 2 channels, the simulated responses 2 of 3; expected the "
    "same");
  EXPECT_NE(printed(difference).find("vtkResponseDifference"), std::string::npos);
}
}

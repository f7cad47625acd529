#include "vtkFlatFieldCorrection.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace msi;
using namespace msi::testing;

vtkSmartPointer<vtkImageData> counts(int width, int height, const std::vector<double>& values)
{
  return newImage(width, height, "counts",
    Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

Eigen::MatrixXd corrected(vtkFlatFieldCorrection* correction)
{
  return valuesOf(correction->GetOutput(), ResponsesArray);
}

TEST(FlatFieldOptions, ComparesSignalsPerExposureTime)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, counts(2, 1, { 300.0, 500.0 }));
  correction->SetInputData(1, counts(2, 1, { 500.0, 900.0 }));
  correction->SetInputData(2, counts(2, 1, { 100.0, 100.0 }));
  correction->AddExposureTime(20.0);
  correction->AddWhiteExposureTime(10.0);
  ASSERT_EQ(errorOf(correction), "");
  // 200 in 20 ms against 400 in 10 ms.
  EXPECT_EQ(corrected(correction), (Eigen::RowVector2d(0.25, 0.25)));
  correction->ClearWhiteExposureTimes();
  EXPECT_EQ(errorOf(correction),
    "WhiteExposureTimes are missing; give the times of both, or of none where they are equal");
  correction->AddWhiteExposureTime(1.0);
  correction->AddWhiteExposureTime(2.0);
  EXPECT_EQ(errorOf(correction),
    "WhiteExposureTimes holds 2 times; expected one for all channels or 1, one for each, all above "
    "0");
}

TEST(FlatFieldOptions, MasksDeadAndSaturatedValues)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, counts(4, 1, { 10.0, 4095.0, 50.0, 20.0 }));
  correction->SetInputData(1, counts(4, 1, { 100.0, 100.0, 0.0, 4095.0 }));
  correction->SetSaturationLevel(4095.0);
  correction->SetComputeMask(true);
  ASSERT_EQ(errorOf(correction), "");
  EXPECT_EQ(valuesOf(correction->GetOutput(), "Mask"), (Eigen::RowVector4d(0, 2, 1, 4)));
  const auto values = corrected(correction);
  EXPECT_FLOAT_EQ(static_cast<float>(values(0, 0)), 0.1F);
  EXPECT_TRUE(values.rightCols(3).array().isNaN().all());
  EXPECT_EQ(correction->GetDeadCount(), 1);
  EXPECT_EQ(correction->GetSaturatedCount(), 2);
}

TEST(FlatFieldOptions, TakesOneRowOrOneColumnForAll)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, counts(2, 2, { 1.0, 2.0, 3.0, 4.0 }));
  correction->SetInputData(1, counts(2, 1, { 2.0, 4.0 }));
  ASSERT_EQ(errorOf(correction), "");
  EXPECT_EQ(corrected(correction), (Eigen::RowVector4d(0.5, 0.5, 1.5, 1.0)));
  correction->SetInputData(1, counts(1, 2, { 2.0, 4.0 }));
  ASSERT_EQ(errorOf(correction), "");
  EXPECT_EQ(corrected(correction), (Eigen::RowVector4d(0.5, 1.0, 0.75, 1.0)));
  correction->SetInputData(1, counts(3, 1, { 2.0, 4.0, 8.0 }));
  EXPECT_EQ(errorOf(correction),
    "the white image has 3 x 1 pixels, but the raw image has 2 x 2; take both with the same camera "
    "settings");
}

TEST(FlatFieldOptions, GivesTheSameBytesInPiecesWithOneRow)
{
  vtkNew<PieceSource> raw;
  vtkNew<PieceSource> white;
  raw->SetImage(newImage(40, 30, "counts", patternValues(3, 1200)));
  white->SetImage(newImage(40, 1, "counts", patternValues(3, 40)));
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputConnection(0, raw->GetOutputPort());
  correction->SetInputConnection(1, white->GetOutputPort());
  expectSameBytesInPieces(correction, 6);
}
}
